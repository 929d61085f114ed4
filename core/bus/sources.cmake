target_sources(dynascope_core PRIVATE
    bus/asking.h
    bus/bus.cpp bus/bus.h bus/bus_values.h
    bus/busthread.cpp bus/busthread.h
    bus/buswaiting.cpp bus/buswaiting.h
    bus/busworker.cpp bus/busworker.h
    bus/channel.cpp bus/channel.h
    bus/collector.cpp bus/collector.h
    bus/cyclelimit.cpp bus/cyclelimit.h
    bus/jobcontext.h
    bus/jobqueue.cpp bus/jobqueue.h
    bus/lateanswers.cpp bus/lateanswers.h
    bus/learnedtiming.cpp bus/learnedtiming.h
    bus/line.cpp bus/line.h bus/linefactory.h bus/traits.h
    bus/messages.cpp bus/messages.h bus/messages_latency.cpp bus/messagetext.h
    bus/networkaddress.cpp bus/networkaddress_values.h
    bus/networkline.cpp bus/networkline.h bus/networklinefactory.h
    bus/operations.cpp bus/operations.h
    bus/outbox.cpp bus/outbox.h
    bus/batch_values.h
    bus/poll_values.h
    bus/poller.cpp bus/poller.h bus/poller_plan.cpp
    bus/pollmeasure.cpp bus/pollmeasure.h
    bus/pollprediction.cpp bus/pollprediction.h
    bus/pollschedule.cpp bus/pollschedule.h
    bus/pollturns.cpp bus/pollturns.h
    bus/quality.cpp bus/quality.h bus/quality_values.h
    bus/ratelimit.cpp bus/ratelimit.h bus/ratelimit_values.h
    bus/readchoice.cpp bus/readchoice.h
    bus/readcost.cpp bus/readcost.h
    bus/readgroups.cpp bus/readgroups.h
    bus/readplan.cpp bus/readplan.h
    bus/remainder.cpp bus/remainder.h
    bus/rfc2217.cpp bus/rfc2217.h
    bus/scan.cpp bus/scan.h bus/scancompare.cpp
    bus/serialbaud_posix.cpp
    bus/serialline.cpp bus/serialline.h bus/seriallinefactory.h
    bus/serialportlist.cpp
    bus/serialport_posix.cpp bus/serialport_posix.h
    bus/stop_values.h
    bus/stopsequence.cpp bus/stopsequence.h
    bus/tcpsocket_posix.cpp bus/tcpsocket_posix.h
    bus/timing.cpp bus/timing.h
    bus/usbidentity.cpp bus/usbidentity.h
)
