target_sources(dynascope_ui PRIVATE
    connection/baudcombo.cpp connection/baudcombo.h
    connection/connectionbar.cpp connection/connectionbar.h
    connection/connector.cpp connection/connector.h
    connection/portcombo.cpp connection/portcombo.h
    connection/scanoptions.cpp connection/scanoptions.h
    connection/stopbutton.cpp connection/stopbutton.h
)
