target_sources(dynascope_ui PRIVATE
    devices/changebauddialog.cpp devices/changebauddialog.h
    devices/changeiddialog.cpp devices/changeiddialog.h
    devices/deviceactions.cpp devices/deviceactions.h devices/deviceactions_restart.cpp
    devices/devicedelegate.cpp devices/devicedelegate.h
    devices/devicedialog.cpp devices/devicedialog.h
    devices/devicepanel.cpp devices/devicepanel.h
    devices/devicetree.cpp devices/devicetree.h
    devices/devicetreemodel.cpp devices/devicetreemodel.h
    devices/devicetreetexts.cpp
    devices/factoryresetdialog.cpp devices/factoryresetdialog.h
    devices/leftmoves.cpp devices/leftmoves.h
    devices/movedialog.cpp devices/movedialog.h
    devices/movestepsmodel.cpp devices/movestepsmodel.h
    devices/movewishes.cpp devices/movewishes.h
    devices/nicknames.cpp devices/nicknames.h
    devices/resetmanydialog.cpp devices/resetmanydialog.h
)
