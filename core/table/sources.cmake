target_sources(dynascope_core PRIVATE
    table/catalog.cpp table/catalog.h
    table/cellrows.cpp table/cellrows.h
    table/controltable.cpp table/controltable.h
    table/effectivefield.cpp table/effectivefield.h
    table/field.h
    table/fieldchanges.cpp table/fieldchanges.h
    table/fieldreader.cpp table/fieldreader.h table/fieldreader_values.cpp
    table/indirect.cpp table/indirect.h
    table/jsonguard.cpp table/jsonguard.h
    table/jsonscanner.cpp table/jsonscanner.h
    table/nearestnames.cpp table/nearestnames.h
    table/parsevalue.cpp
    table/memo.h
    table/motorturn.cpp table/motorturn.h
    table/rawtable.cpp table/rawtable.h
    table/registerindex.cpp table/registerindex.h
    table/tablebuilder.cpp table/tablebuilder.h table/tablebuilder_checks.cpp
    table/tablefault.h
    table/tablefile.cpp table/tablefile.h
    table/tableimport.cpp table/tableimport.h table/tableimport_csv.cpp table/tableimport_model.cpp
    table/tableimporter.h
    table/tablemerge.cpp table/tablemerge.h
    table/tableoutline.cpp table/tableoutline.h
    table/tablewriter.cpp table/tablewriter.h
    table/typedunits.h
    table/units.cpp table/units.h
    table/usertables.cpp table/usertables.h
)

# A new servo is a new file: nothing has to be written here for it.
set(DYNASCOPE_TABLES ${PROJECT_SOURCE_DIR}/resources/controltables)
file(GLOB DYNASCOPE_TABLE_FILES CONFIGURE_DEPENDS ${DYNASCOPE_TABLES}/*.json)
qt_add_resources(dynascope_core "controltables" PREFIX "/controltables" BASE ${DYNASCOPE_TABLES}
    OPTIONS --no-compress # read where they lie, without a copy
    FILES ${DYNASCOPE_TABLE_FILES})
