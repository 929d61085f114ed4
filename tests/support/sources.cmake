target_sources(dynascope_test_support PRIVATE
    support/builtincatalog.h support/busworld.h support/exchangetext.h
    support/fakefactory.cpp support/fakefactory.h
    support/fakeline.cpp support/fakeline.h
    support/fakeservos.cpp support/fakeservos.h
    support/hostileline.cpp support/hostileline.h
    support/faultmatrix.cpp support/faultmatrix.h support/faultrequests.cpp
    support/hex.cpp support/hex.h
    support/modelwalk.cpp support/modelwalk.h
    support/mortalline.h
    support/nullline.cpp support/nullline.h
    support/oracle.cpp support/oracle.h
    support/profileworld.h
    support/recordings.h
    support/sanitized.h
    support/tablefacts.cpp support/tablefacts.h
    support/servobench.h
    support/backupworld.h
    support/settingsworld.h
    support/sessionfixture.h
    support/simclient.h
    support/testmain.cpp support/testmain.h
    support/undoworld.h
)
if(UNIX)
    target_sources(dynascope_test_support PRIVATE
        support/dxlprocess_posix.cpp support/dxlprocess.h support/dxlbus.h
        support/ser2net_posix.cpp support/ser2net.h
        support/ptyclient_posix.cpp support/ptyclient.h
        support/loopbackserver_posix.cpp support/loopbackserver.h
        support/ptymaster_posix.cpp support/ptymaster.h
        support/udpreceiver_posix.cpp support/udpreceiver.h
    )
endif()
