target_sources(dynascope_core PRIVATE
    replay/recordedlines.cpp replay/recordedlines.h
    replay/replayclock.cpp replay/replayclock.h
    replay/replaydata.cpp replay/replaydata.h
    replay/replaydevices.cpp replay/replaydevices.h
    replay/replayer.cpp replay/replayer.h
)
