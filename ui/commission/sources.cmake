target_sources(dynascope_ui PRIVATE
    commission/commissiondialog.cpp commission/commissiondialog.h
    commission/commissionmodel.cpp commission/commissionmodel.h
    commission/commissionsetup.cpp commission/commissionsetup.h
    commission/commissiontexts.cpp commission/commissiontexts.h
)
