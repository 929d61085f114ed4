target_sources(dynascope_core PRIVATE
    protocol/crc16.cpp protocol/crc16.h
    protocol/packet.cpp protocol/packet.h
    protocol/parser.cpp protocol/parser.h
    protocol/protocol_values.cpp protocol/protocol_values.h
    protocol/requests.cpp protocol/requests.h
    protocol/stuffing.cpp protocol/stuffing.h
)
