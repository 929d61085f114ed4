target_sources(dynascope_core PRIVATE yaml/yamltree.cpp yaml/yamltree.h)
