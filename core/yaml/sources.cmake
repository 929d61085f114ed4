target_sources(dynascope_core PRIVATE
    yaml/yamledit.cpp yaml/yamledit.h
    yaml/yamltree.cpp yaml/yamltree.h
)
