target_sources(dynascope_core PRIVATE
    yaml/yamledit.cpp yaml/yamledit.h
    yaml/yamlfaults.cpp yaml/yamlfaults.h
    yaml/yamltree.cpp yaml/yamltree.h
)
