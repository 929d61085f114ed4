target_sources(dynascope_core PRIVATE
    session/device.cpp session/device.h
)
