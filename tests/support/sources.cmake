target_sources(dynascope_test_support PRIVATE support/oracle.cpp support/oracle.h
    support/testmain.cpp support/testmain.h)
target_sources(dynascope_test_support PRIVATE support/simclient.h)
if(UNIX)
    target_sources(dynascope_test_support PRIVATE support/ptyclient_posix.cpp support/ptyclient.h)
endif()
