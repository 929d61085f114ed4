target_sources(dynascope_core PRIVATE
    sim/controller.cpp sim/controller.h
    sim/joint.cpp sim/joint.h sim/jointstate.cpp sim/jointvalues.h
    sim/load.cpp sim/load.h
    sim/motor.cpp sim/motor.h sim/motorlibrary.cpp
    sim/plant.cpp sim/plant.h
    sim/profile.cpp sim/profile.h
    sim/supply.cpp sim/supply.h
)
target_sources(dynascope_core PRIVATE
    sim/adapter.cpp sim/adapter.h
    sim/baudmismatch.cpp sim/baudmismatch.h
    sim/busfile.cpp sim/busplan.cpp sim/busplan.h
    sim/chance.h
    sim/control.cpp sim/control.h sim/controlload.cpp sim/controlnumbers.h
    sim/controlverbs.cpp sim/controlverbs.h
    sim/damage.cpp sim/damage.h
    sim/demoscript.cpp sim/demoscript.h
    sim/eepromwrites.cpp sim/eepromwrites.h
    sim/faulttext.cpp sim/faulttext.h
    sim/groupreply.cpp sim/groupreply.h
    sim/hardwareerrors.cpp sim/hardwareerrors.h
    sim/linefaults.h
    sim/motionregisters.cpp sim/motionregisters.h
    sim/pacing.cpp sim/pacing.h
    sim/power.cpp sim/power.h
    sim/reaction.h
    sim/registerfile.cpp sim/registerfile.h sim/registernames.cpp
    sim/replyspoiler.cpp sim/replyspoiler.h
    sim/servo.cpp sim/servo.h sim/servocommands.cpp sim/servopower.cpp
    sim/servosettings.h sim/servowrites.cpp
    sim/servospec.h sim/servospecs.cpp
    sim/simulatedbus.cpp sim/simulatedbus.h
    sim/simulatedline.cpp sim/simulatedline.h
    sim/truth.cpp sim/truth.h
    sim/wire.cpp sim/wire.h
)
if(UNIX)
    target_sources(dynascope_core PRIVATE
        sim/controlchannel_posix.cpp sim/controlchannel.h sim/controlsocket_posix.cpp sim/controlsocket.h
        sim/demo.cpp sim/demo.h
        sim/packetassembler.cpp sim/packetassembler.h
        sim/pseudoterminal_posix.cpp sim/pseudoterminal.h
        sim/ptybaud_posix.cpp sim/ptybaud.h
        sim/ptyserver_posix.cpp sim/ptyserver.h
        sim/systemfailure_posix.h
    )
endif()

qt_add_resources(dynascope_core "motors" PREFIX "/motors" BASE ${PROJECT_SOURCE_DIR}/resources
    FILES ${PROJECT_SOURCE_DIR}/resources/motors.json)
