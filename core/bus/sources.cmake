target_sources(dynascope_core PRIVATE
    bus/bus.cpp bus/bus.h bus/bus_values.h
    bus/collector.cpp bus/collector.h
    bus/line.h bus/linefactory.h bus/traits.h
    bus/messages.cpp bus/messages.h
    bus/operations.cpp bus/operations.h
    bus/poll_values.h
    bus/poller.cpp bus/poller.h
    bus/readplan.cpp bus/readplan.h
    bus/remainder.cpp bus/remainder.h
    bus/scan.cpp
    bus/stop_values.h
    bus/timing.cpp bus/timing.h
)
