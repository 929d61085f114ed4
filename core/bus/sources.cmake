target_sources(dynascope_core PRIVATE
)
