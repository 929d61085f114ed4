target_sources(dynascope_ui PRIVATE
    health/healthdelegate.cpp health/healthdelegate.h
    health/healthmodel.cpp health/healthmodel.h
    health/healthpanel.cpp health/healthpanel.h
    health/healthtexts.cpp health/healthtexts.h
    health/indirectnotice.cpp health/indirectnotice.h
    health/packingbox.cpp health/packingbox.h
    health/ratebar.cpp health/ratebar.h
    health/ratepopup.cpp health/ratepopup.h
    health/rateremedies.cpp health/rateremedies.h
    health/ratetexts.cpp health/ratetexts.h
    health/wantedrates.cpp health/wantedrates.h
)
