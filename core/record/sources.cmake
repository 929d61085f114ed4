target_sources(dynascope_core PRIVATE
    record/csvsink.cpp record/csvsink.h
    record/jsonsample.cpp record/jsonsample.h
    record/mcapformat.cpp record/mcapformat.h
    record/mcapmetadata.cpp record/mcapmetadata.h
    record/mcapreader.cpp record/mcapreader.h
    record/mcapsink.cpp record/mcapsink.h
    record/mcapwriter.cpp record/mcapwriter.h
    record/recorder.cpp record/recorder.h
    record/recordedvalue.cpp record/recordedvalue.h
    record/recordfile_posix.cpp record/recordfile_posix.h
    record/recording.cpp record/recording.h
    record/recording_values.h
    record/recordingsink.h
    record/recordqueue.cpp record/recordqueue.h
    record/recordwriter.cpp record/recordwriter.h
    record/udpsender_posix.cpp record/udpsender_posix.h
    record/valuelayout.cpp record/valuelayout.h
)
