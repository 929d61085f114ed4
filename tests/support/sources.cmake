target_sources(dynascope_test_support PRIVATE
    support/oracle.cpp support/oracle.h
    support/sessionfixture.h
    support/simclient.h
    support/testmain.cpp support/testmain.h
)
if(UNIX)
    target_sources(dynascope_test_support PRIVATE
        support/dxlprocess_posix.cpp support/dxlprocess.h
        support/ptyclient_posix.cpp support/ptyclient.h
    )
endif()
