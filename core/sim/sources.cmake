target_sources(dynascope_core PRIVATE
    sim/controller.cpp sim/controller.h
    sim/joint.cpp sim/joint.h
    sim/motor.cpp sim/motor.h
    sim/plant.cpp sim/plant.h
    sim/profile.cpp sim/profile.h
)
