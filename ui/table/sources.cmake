target_sources(dynascope_ui PRIVATE
    table/bitpopup.cpp table/bitpopup.h
    table/cellpainter.cpp table/cellpainter.h
    table/changetracker.cpp table/changetracker.h
    table/comparison.cpp table/comparison.h
    table/consequencesdialog.cpp table/consequencesdialog.h
    table/editflow.cpp table/editflow.h
    table/enumedit.cpp table/enumedit.h
    table/fielddelegate.cpp table/fielddelegate.h
    table/fieldfiltermodel.cpp table/fieldfiltermodel.h
    table/fieldgroups.cpp table/fieldgroups.h
    table/fieldtablemodel.cpp table/fieldtablemodel.h
    table/fieldtablemodel_edit.cpp table/fieldtablemodel_updates.cpp table/fieldtablemodel_values.cpp
    table/fieldwordsmodel.cpp table/fieldwordsmodel.h
    table/frozennames.cpp table/frozennames.h
    table/goalbar.cpp table/goalbar.h
    table/goalslider.cpp table/goalslider.h
    table/helppanel.cpp table/helppanel.h
    table/limitwords.cpp table/limitwords.h
    table/lockbar.cpp table/lockbar.h
    table/registerrows.cpp table/registerrows.h
    table/tableactions.cpp table/tableactions.h
    table/tableempty.cpp table/tableempty.h
    table/tableheader.cpp table/tableheader.h
    table/tablemenu.cpp table/tablemenu.h
    table/tablepanel.cpp table/tablepanel.h table/tablepanel_state.cpp table/tablepanel_groups.cpp
    table/tableroles.h
    table/tablenote.cpp table/tablenote.h
    table/tabletools.cpp table/tabletools.h
    table/tableview.cpp table/tableview.h
    table/unknownwrite.cpp table/unknownwrite.h
    table/valueedit.cpp table/valueedit.h
    table/valuemeaning.cpp table/valuemeaning.h
    table/writethrottle.cpp table/writethrottle.h
)
