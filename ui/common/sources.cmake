target_sources(dynascope_ui PRIVATE
    common/elidedlabel.cpp common/elidedlabel.h
    common/fieldtexts.cpp common/fieldtexts.h
    common/filedialogs.cpp common/filedialogs.h
    common/flatcontrols.cpp common/flatcontrols.h
    common/flatstyle.cpp common/flatstyle.h
    common/icons.cpp common/icons.h
    common/loweredge.cpp common/loweredge.h
    common/messagebar.cpp common/messagebar.h
    common/present.cpp common/present.h
    common/stopkey.cpp common/stopkey.h
    common/texts.cpp common/texts.h
    common/theme.cpp common/theme.h
    common/watchmime.cpp common/watchmime.h
)
