target_sources(dynascope_core PRIVATE
    table/catalog.cpp table/catalog.h
    table/controltable.cpp table/controltable.h
    table/field.h
    table/fieldreader.cpp table/fieldreader.h
    table/jsonguard.cpp table/jsonguard.h
    table/parsevalue.cpp
    table/tablebuilder.cpp table/tablebuilder.h
    table/tablemerge.cpp table/tablemerge.h
    table/units.cpp table/units.h
)

# A new servo is a new file: nothing has to be written here for it.
set(DYNASCOPE_TABLES ${PROJECT_SOURCE_DIR}/resources/controltables)
file(GLOB DYNASCOPE_TABLE_FILES CONFIGURE_DEPENDS ${DYNASCOPE_TABLES}/*.json)
qt_add_resources(dynascope_core "controltables" PREFIX "/controltables" BASE ${DYNASCOPE_TABLES}
    FILES ${DYNASCOPE_TABLE_FILES})
