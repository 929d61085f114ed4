target_sources(dynascope_test_support PRIVATE support/oracle.cpp support/oracle.h
    support/testmain.cpp support/testmain.h)
