target_sources(dynascope_ui PRIVATE
)
