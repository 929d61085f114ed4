target_sources(dynascope_test_support PRIVATE support/oracle.cpp support/oracle.h
    support/dxlprocess_posix.cpp support/dxlprocess.h support/testmain.cpp support/testmain.h)
