target_sources(dynascope_ui PRIVATE
    common/flatstyle.cpp common/flatstyle.h
    common/icons.cpp common/icons.h
    common/theme.cpp common/theme.h
    common/watchmime.cpp common/watchmime.h
)
