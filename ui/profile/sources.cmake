target_sources(dynascope_ui PRIVATE
    profile/profilefaults.cpp profile/profilefaults.h
    profile/profilefilebar.cpp profile/profilefilebar.h
    profile/profilefilter.cpp profile/profilefilter.h
    profile/profilemodel.cpp profile/profilemodel.h
    profile/profilenote.cpp profile/profilenote.h
    profile/profileplanpage.cpp profile/profileplanpage.h
    profile/profiletexts.cpp profile/profiletexts.h
    profile/profileview.cpp profile/profileview.h profile/profileview_say.cpp
)
