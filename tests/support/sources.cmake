target_sources(dynascope_test_support PRIVATE
    support/dxlprocess.h support/dxlprocess_posix.cpp
    support/oracle.cpp support/oracle.h
    support/ptyclient.h support/ptyclient_posix.cpp
    support/simclient.h
    support/testmain.cpp support/testmain.h
)
