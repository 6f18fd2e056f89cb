"""A payload's head and its sections (EXTENSION_SPEC.md, Appendix A)."""
import zlib

from models import require
from value_models import varint


class Payload:
    def __init__(self, data):
        require(data[:5] == b'TUTT\0', 'no payload of version 0')
        flags, at = varint(data, 5)
        require(flags < 256 and flags & 1, 'flags')
        self.welded = flags >> 7
        require(not self.welded or flags >> 1 & 1, 'a welded payload without SEAMS')

        def count(present, otherwise):
            nonlocal at
            if not present:
                return otherwise
            value, at = varint(data, at)
            return value

        self.vertices = count(True, 0)
        self.points = self.vertices - count(self.welded, -1) - 1
        self.wedges = self.vertices + count(flags >> 1 & 1, 0)
        self.faces = count(True, 0)
        self.corners = count(True, 0)
        usual = max(0, self.corners - 2 * self.faces)
        self.triangles = count(flags >> 6 & 1, usual)
        self.groups = count(flags >> 2 & 1, 0) + 1
        self.attributes = count(flags >> 5 & 1, -1) + 1
        require(not self.welded or 0 < self.points < self.vertices, 'counts')
        self.sections = self.read_sections(data, at, [s for s in range(6) if flags >> s & 1])

    @staticmethod
    def read_sections(data, at, present):
        head, lengths, sections, table = data[:at], b'', {}, []
        for section in present:
            size, end = varint(data, at)
            lengths += data[at:end]
            table.append((section, size, int.from_bytes(data[end:end + 4], 'little')))
            at = end + 4
        for section, size, checksum in table:
            sections[section] = data[at:at + size]
            require(zlib.crc32(head + lengths + sections[section]) == checksum, 'a checksum')
            at += size
        require(at == len(data), 'bytes behind the payload')
        return sections
