target_sources(dynascope_ui PRIVATE
    replay/openrecording.cpp replay/openrecording.h
    replay/replaybar.cpp replay/replaybar.h
    replay/replaytexts.cpp replay/replaytexts.h
    replay/replaywindow.cpp replay/replaywindow.h
    replay/timeline.cpp replay/timeline.h
)
