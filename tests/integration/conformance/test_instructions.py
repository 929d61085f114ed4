# SPDX-License-Identifier: GPL-3.0-or-later
"""Each instruction the simulator knows, at each Status Return Level, to one device and to all: who answers, and what."""
import unittest

from stranger import *

MODEL, FIRMWARE = 1020, 45  # XM430-W350
ID, RETURN_DELAY, SECONDARY_ID, HOMING, STATUS_LEVEL = 7, 9, 12, 20, 68
TORQUE, LED, REGISTERED, HARDWARE_ERROR, GOAL, PRESENT = 64, 65, 69, 70, 116, 132
INDIRECT_ADDRESS, INDIRECT_DATA = 168, 224
LIMIT_MAX, LIMIT_MIN = 48, 52
RESULT_FAIL, INSTRUCTION, DATA_RANGE, DATA_LENGTH, DATA_LIMIT, ACCESS = 1, 2, 4, 5, 6, 7

RESET = u8(2)  # all but ID and baud rate
CLEAR_POSITION = u8(1, 0x44, 0x58, 0x4C, 0x22)
STORE = u8(1, 0x43, 0x54, 0x52, 0x4C)

# name, instruction, parameters, the level from which on it is answered, data of the answer, is a broadcast answered
UNICAST = [
    ("Ping", PING, b"", 0, u16(MODEL) + u8(FIRMWARE), True),
    ("Read", READ, u16(ID, 1), 1, u8(1), False),
    ("Write", WRITE, u16(LED) + u8(1), 2, b"", False),
    ("Reg Write", REG_WRITE, u16(LED) + u8(1), 2, b"", False),
    ("Action", ACTION, b"", 2, b"", False),
    ("Factory Reset", FACTORY_RESET, RESET, 2, b"", False),
    ("Reboot", REBOOT, b"", 2, b"", False),
    ("Clear", CLEAR, CLEAR_POSITION, 2, b"", False),
    ("Control Table Backup", BACKUP, STORE, 2, b"", False),
]
# name, instruction, parameters, the level from which on it is answered (3: never), answers as (id, data)
GROUP = [
    ("Sync Read", SYNC_READ, u16(ID, 1) + u8(1, 2), 1, [(1, u8(1)), (2, u8(2))]),
    ("Bulk Read", BULK_READ, u8(2) + u16(ID, 1) + u8(1) + u16(STATUS_LEVEL, 1), 1, [(2, u8(2)), (1, None)]),
    ("Sync Write", SYNC_WRITE, u16(LED, 1) + u8(1, 1, 2, 1), 3, []),
    ("Bulk Write", BULK_WRITE, u8(1) + u16(LED, 1) + u8(1) + u8(2) + u16(LED, 1) + u8(1), 3, []),
]


class Bus(unittest.TestCase):
    devices = "XM430-W350@1000000:1,XM430-W350@1000000:2"

    def setUp(self):
        self.sim = Sim("--devices", self.devices)
        self.port = Port(self.sim.path, 1000000)

    def tearDown(self):
        self.port.close()
        self.sim.stop()

    def level(self, value):
        for device in (1, 2):
            self.port.write(device, STATUS_LEVEL, u8(value))
            self.assertEqual(self.port.one(packet(device, PING)).id, device)

    def set_level(self, device, value):
        """Whether that is answered depends on both levels: what counts is that a Ping after it is."""
        self.port.send(packet(device, WRITE, u16(STATUS_LEVEL), u8(value)))
        self.port.receive(lambda data: bool(split(data)[0]), patience=0.1)

    def awake(self):
        """After a reboot: deaf for a while, then there."""
        self.assertTrue(until(lambda: self.port.ask(packet(1, PING), 1, patience=0.1)))
        self.assertTrue(until(lambda: self.port.ask(packet(2, PING), 1, patience=0.1)))


class EveryInstruction(Bus):
    def test_unicast(self):
        for level in (0, 1, 2):
            for name, instruction, parameters, since, data, _ in UNICAST:
                with self.subTest(instruction=name, level=level):
                    self.awake()
                    if name == "Action":
                        self.port.ask(packet(1, REG_WRITE, u16(LED), u8(1)), 0)
                    self.set_level(1, level)
                    answers = self.port.ask(packet(1, instruction, parameters), 1 if level >= since else 0)
                    self.assertEqual(answers, [Status(1, 0, data)] if level >= since else [])
                    self.awake()
                    self.set_level(1, 2)

    def test_broadcast(self):
        for level in (0, 1, 2):
            for name, instruction, parameters, since, data, answered in UNICAST:
                with self.subTest(instruction=name, level=level):
                    self.awake()
                    for device in (1, 2):
                        self.set_level(device, level)
                    answers = self.port.ask(packet(BROADCAST, instruction, parameters), 2 if answered else 0)
                    self.assertEqual(answers, [Status(1, 0, data), Status(2, 0, data)] if answered else [])
                    self.awake()
                    for device in (1, 2):
                        self.set_level(device, 2)

    def test_group(self):
        for level in (0, 1, 2):
            for name, instruction, parameters, since, expected in GROUP:
                with self.subTest(instruction=name, level=level):
                    for device in (1, 2):
                        self.set_level(device, level)
                    heard = expected if level >= since else []
                    wanted = [Status(device, 0, u8(level) if data is None else data) for device, data in heard]
                    self.assertEqual(self.port.ask(packet(BROADCAST, instruction, parameters), len(wanted)), wanted)
                    # Group instructions are for everyone: to one device they are nothing.
                    self.assertEqual(self.port.ask(packet(1, instruction, parameters), 0), [])
                    for device in (1, 2):
                        self.set_level(device, 2)

    def test_fast(self):
        requests = {"sync": packet(BROADCAST, FAST_SYNC_READ, u16(ID, 1), u8(1, 2)),
                    "bulk": packet(BROADCAST, FAST_BULK_READ, u8(1), u16(ID, 1), u8(2), u16(ID, 1))}
        for level in (0, 1, 2):
            for name, request in requests.items():
                with self.subTest(instruction=name, level=level):
                    for device in (1, 2):
                        self.set_level(device, level)
                    self.port.send(request)
                    size = 8 + 2 * 5
                    heard = self.port.receive(lambda data: len(data) >= size, patience=1.0 if level else 0.12)
                    expected = b"\xff\xff\xfd\x00\xfe" + u16(1 + 2 * 5) + u8(STATUS)
                    for device in (1, 2):
                        expected += u8(0, device, device)
                        expected += u16(crc(expected))
                    self.assertEqual(heard, expected if level >= 1 else b"")
                    for device in (1, 2):
                        self.set_level(device, 2)

    def test_writes_to_all_are_obeyed(self):
        self.assertEqual(self.port.ask(packet(BROADCAST, WRITE, u16(LED), u8(1)), 0), [])
        self.assertEqual([self.port.read(device, LED, 1) for device in (1, 2)], [1, 1])
        self.assertEqual(self.port.ask(packet(BROADCAST, SYNC_WRITE, u16(LED, 1), u8(1, 0, 2, 0)), 0), [])
        self.assertEqual([self.port.read(device, LED, 1) for device in (1, 2)], [0, 0])
        self.assertEqual(self.port.ask(packet(BROADCAST, REG_WRITE, u16(LED), u8(1)), 0), [])
        self.assertEqual([self.port.read(device, REGISTERED, 1) for device in (1, 2)], [1, 1])
        self.assertEqual(self.port.ask(packet(BROADCAST, ACTION), 0), [])
        self.assertEqual([self.port.read(device, LED, 1) for device in (1, 2)], [1, 1])


class ChainRule(Bus):
    def test_missing(self):
        read = lambda *ids: packet(BROADCAST, SYNC_READ, u16(ID, 1), u8(*ids))
        self.assertEqual(self.port.ask(read(1, 9, 2), 1), [Status(1, 0, u8(1))])
        self.assertEqual(self.port.receive(lambda data: True, patience=0.1), b"")
        self.assertEqual(self.port.ask(read(9, 1, 2), 0), [])
        self.assertEqual(self.port.ask(read(2, 1), 2), [Status(2, 0, u8(2)), Status(1, 0, u8(1))])

    def test_fast_breaks_off(self):
        self.port.send(packet(BROADCAST, FAST_SYNC_READ, u16(ID, 1), u8(1, 9, 2)))
        self.assertEqual(len(self.port.receive(lambda data: len(data) > 13)), 8 + 5)

    def test_old_firmware_stays_silent(self):
        self.tearDown()
        self.sim = Sim("--devices", "XM430-W350/44@1000000:1")
        self.port = Port(self.sim.path, 1000000)
        self.assertEqual(self.port.ask(packet(BROADCAST, FAST_SYNC_READ, u16(ID, 1), u8(1)), 0), [])
        self.assertEqual(self.port.one(packet(1, PING)), Status(1, 0, u16(MODEL) + u8(44)))


class Errors(Bus):
    def test_numbers(self):
        port = self.port
        rows = [
            ("read past the table", packet(1, READ, u16(1000, 4)), ACCESS),
            ("write to a read-only register", packet(1, WRITE, u16(PRESENT), u32(0)), ACCESS),
            ("value out of range", packet(1, WRITE, u16(LED), u8(2)), DATA_RANGE),
            ("fewer bytes than the register", packet(1, WRITE, u16(GOAL), u8(0)), DATA_LENGTH),
            ("Action with nothing registered", packet(1, ACTION), INSTRUCTION),
            ("unknown instruction", packet(1, 0x33), INSTRUCTION),
            ("goal beyond the limit", packet(1, WRITE, u16(GOAL), u32(5000)), DATA_LIMIT),
        ]
        for name, request, number in rows:
            with self.subTest(name):
                answer = port.one(request)
                self.assertIsNotNone(answer)
                self.assertEqual((answer.error, answer.data), (number, b""))

    def test_a_damaged_request_is_not_obeyed(self):
        request = bytearray(packet(1, WRITE, u16(LED), u8(1)))
        request[-1] ^= 1
        self.assertEqual(self.port.ask(bytes(request), 0), [])
        self.assertEqual(self.port.read(1, LED, 1), 0)

    def test_eeprom_lock(self):
        self.assertEqual(self.port.write(1, TORQUE, u8(1)).error, 0)
        self.assertEqual(self.port.write(1, RETURN_DELAY, u8(10)).error, ACCESS)
        self.assertEqual(self.port.one(packet(1, BACKUP, STORE)).error, RESULT_FAIL)
        self.assertEqual(self.port.write(1, LED, u8(1)).error, 0)
        self.assertEqual(self.port.write(1, TORQUE, u8(0)).error, 0)
        self.assertEqual(self.port.write(1, RETURN_DELAY, u8(10)).error, 0)
        self.assertEqual(self.port.read(1, RETURN_DELAY, 1), 10)


class Registers(Bus):
    def test_secondary_id(self):
        self.assertEqual(self.port.write(1, SECONDARY_ID, u8(50)).error, 0)
        self.assertEqual(self.port.ask(packet(50, WRITE, u16(LED), u8(1)), 0), [])
        self.assertEqual(self.port.read(1, LED, 1), 1)
        self.assertEqual(self.port.ask(packet(50, PING), 0), [])
        self.assertEqual(self.port.ask(packet(50, WRITE, u16(RETURN_DELAY), u8(10)), 0), [])
        self.assertNotEqual(self.port.read(1, RETURN_DELAY, 1), 10)

    def test_reg_write_and_action(self):
        self.assertEqual(self.port.one(packet(1, REG_WRITE, u16(LED), u8(1))).error, 0)
        self.assertEqual((self.port.read(1, LED, 1), self.port.read(1, REGISTERED, 1)), (0, 1))
        self.assertEqual(self.port.one(packet(1, ACTION)).error, 0)
        self.assertEqual((self.port.read(1, LED, 1), self.port.read(1, REGISTERED, 1)), (1, 0))
        self.assertEqual(self.port.one(packet(1, ACTION)).error, INSTRUCTION)

    def test_indirect(self):
        self.assertEqual(self.port.write(1, INDIRECT_ADDRESS, u16(LED)).error, 0)
        self.assertEqual(self.port.write(1, INDIRECT_DATA, u8(1)).error, 0)
        self.assertEqual((self.port.read(1, LED, 1), self.port.read(1, INDIRECT_DATA, 1)), (1, 1))
        self.assertEqual(self.port.write(1, INDIRECT_DATA, u8(2)).error, DATA_RANGE)

    def test_reboot(self):
        self.assertEqual(self.port.write(1, LED, u8(1)).error, 0)
        self.assertEqual(self.port.write(1, RETURN_DELAY, u8(10)).error, 0)
        self.assertEqual(self.port.one(packet(1, REBOOT)), Status(1, 0, b""))
        begin = time.monotonic()
        self.assertEqual(self.port.ask(packet(1, PING), 0), [])  # deaf at first
        self.assertTrue(until(lambda: self.port.ask(packet(1, PING), 1, patience=0.05)))
        self.assertGreater(time.monotonic() - begin, 0.2)
        self.assertEqual((self.port.read(1, LED, 1), self.port.read(1, RETURN_DELAY, 1)), (0, 10))

    def test_id_and_baud(self):
        self.assertEqual(self.port.write(1, ID, u8(9)).error, 0)
        self.assertEqual(self.port.one(packet(9, PING)).id, 9)
        self.assertEqual(self.port.ask(packet(1, PING), 0), [])
        answer = self.port.write(9, 8, u8(2))  # 115 200
        self.assertIsNotNone(answer)
        self.assertEqual(self.port.ask(packet(9, PING), 0), [])
        self.port.set_baud(115200)
        self.assertEqual(self.port.one(packet(9, PING)).id, 9)

    def test_stuffing(self):
        pattern = b"\xff\xff\xfd\x00"
        self.assertEqual(self.port.write(1, HOMING, u32(-1)).error, 0)
        for at in range(4):
            self.assertEqual(self.port.write(1, INDIRECT_ADDRESS + 2 * at, u16(224 + 4 + at)).error, 0)
            self.assertEqual(self.port.write(1, INDIRECT_ADDRESS + 8 + 2 * at, u16(116 + at)).error, 0)
        goal = int.from_bytes(pattern, "little")
        self.assertEqual(self.port.write(1, 11, u8(4)).error, 0)  # extended position: any goal within 256 turns
        answer = self.port.write(1, GOAL, u32(goal))
        self.assertIn(answer.error, (0, DATA_RANGE, DATA_LIMIT))
        answer = self.port.one(packet(1, READ, u16(HOMING, 4)))
        self.assertEqual(answer.data, b"\xff\xff\xff\xff")


if __name__ == "__main__":
    unittest.main()
