"""Reads recordings with other people's readers and holds them to what a recording promises.

    python -m venv venv && venv/bin/pip install mcap mcap-protobuf-support mcap-ros2-support foxglove-sdk
    venv/bin/python tests/python/read_mcap.py run.mcap [more.mcap ...]

Exit code 0: every file was read with its CRCs, every message decoded by the schema that travels with it, times in order,
attachments and metadata there, and a copy cut at 60 % gave back all of its whole chunks. With `foxglove-sdk` installed the
schemas are compared with the published ones.
"""

import collections
import hashlib
import io
import math
import struct
import sys

from google.protobuf.descriptor_pb2 import FileDescriptorSet
from mcap.exceptions import McapError
from mcap.reader import make_reader
from mcap.records import Attachment, Channel, Chunk, Message, Metadata, Schema
from mcap.stream_reader import StreamReader
from mcap_protobuf.decoder import DecoderFactory as ProtobufDecoder
from mcap_ros2.decoder import DecoderFactory as Ros2Decoder


def records(data):
    """All records up to the end or the first damage, with the damage."""
    found = []
    try:
        for record in StreamReader(io.BytesIO(data), validate_crcs=True).records:
            found.append(record)
    except (McapError, EOFError, ValueError, struct.error) as error:
        return found, error
    return found, None


def decode(found):
    """Decodes every message; gives the last decoded one and the number of each topic, and the times."""
    factories = {"protobuf": ProtobufDecoder(), "cdr": Ros2Decoder()}
    schemas, channels, decoders = {}, {}, {}
    many, last, times = collections.Counter(), {}, []
    for record in found:
        if isinstance(record, Schema):
            schemas[record.id] = record
        elif isinstance(record, Channel):
            channels[record.id] = record
        elif isinstance(record, Message):
            channel = channels[record.channel_id]
            if channel.id not in decoders:
                factory = factories[channel.message_encoding]
                decoders[channel.id] = factory.decoder_for(
                    channel.message_encoding, schemas[channel.schema_id]
                )
                assert decoders[channel.id], f"no decoder for {channel.topic}"
            last[channel.topic] = decoders[channel.id](record.data)
            many[channel.topic] += 1
            times.append(record.log_time)
    return many, last, times, schemas, channels


def unknown_fields(message):
    """Whether a protobuf message has a field its schema does not know."""
    from google.protobuf.unknown_fields import UnknownFieldSet

    if len(UnknownFieldSet(message)):
        return True
    inner = []
    for field, value in message.ListFields():
        if field.message_type:
            inner.extend([value] if hasattr(value, "ListFields") else value)
    return any(unknown_fields(each) for each in inner)


def published(schemas):
    """Names of the schemas that are field for field the published ones, and of those that are not."""
    try:
        import foxglove.messages as official
    except ImportError:
        try:
            import foxglove.schemas as official
        except ImportError:
            return None

    def fields(data):
        files = FileDescriptorSet.FromString(bytes(data)).file
        told = {}
        for file in files:
            for message in file.message_type:
                name = f"{file.package}.{message.name}"
                for field in message.field:
                    told[name, field.number] = (
                        field.name, field.type, field.label, field.type_name, field.proto3_optional,
                    )
                for enum in message.enum_type:
                    for value in enum.value:
                        told[name, enum.name, value.number] = value.name
        return told

    same, other = [], []
    for schema in schemas.values():
        short = schema.name.removeprefix("foxglove.")
        if schema.name == short or not hasattr(official, short):
            continue
        theirs = getattr(official, short).get_schema()
        (same if fields(schema.data) == fields(theirs.data) else other).append(short)
    return same, other


def near(value):
    """Whether a decoded number is one."""
    return isinstance(value, float) and math.isfinite(value)


def check(path):
    data = open(path, "rb").read()
    found, damage = records(data)
    assert damage is None, f"{path}: {damage}"
    many, last, times, schemas, channels = decode(found)
    assert times == sorted(times), "times are not in order"
    names = [record.name for record in found if isinstance(record, Attachment)]
    notes = {record.name: record.metadata for record in found if isinstance(record, Metadata)}
    assert len(names) >= 2 and "report.json" in names, names
    assert {"twin.run", "twin.verdict"} <= notes.keys(), notes
    ros = channels and next(iter(channels.values())).message_encoding == "cdr"
    if ros:
        assert len(last["/joint_states"].name) == len(last["/joint_states"].position)
        assert all(near(x) for x in last["/joint_states"].position)
        quaternion = last["/tf"].transforms[0].transform.rotation
    else:
        for topic, message in last.items():
            assert not unknown_fields(message), topic
        assert all(joint.HasField("position") for joint in last["/joint_states"].joints)
        quaternion = last["/tf"].transforms[0].rotation
    norm = math.sqrt(sum(getattr(quaternion, axis) ** 2 for axis in "xyzw"))
    assert abs(norm - 1.0) < 1e-9, norm

    reader = make_reader(io.BytesIO(data), validate_crcs=True)
    summary = reader.get_summary()
    assert summary.statistics.message_count == len(times)
    assert sum(1 for _ in reader.iter_messages()) == len(times), "by index"

    cut = len(data) * 6 // 10
    some, damage = records(data[:cut])
    kept = sum(isinstance(record, Message) for record in some)
    ends = [(c.chunk_start_offset + c.chunk_length, sum(1 for _ in c.message_index_offsets))
            for c in summary.chunk_indexes]
    whole = sum(end <= cut for end, _ in ends)
    chunks = [r for r in StreamReader(io.BytesIO(data), emit_chunks=True).records
              if isinstance(r, Chunk)]
    from mcap.stream_reader import breakup_chunk
    wanted = sum(isinstance(r, Message) for c in chunks[:whole] for r in breakup_chunk(c, True))
    assert damage is not None and kept >= wanted, f"{kept} of {wanted} messages of whole chunks"

    print(f"{path}: {len(data)} bytes, sha256 {hashlib.sha256(data).hexdigest()[:16]}")
    print(f"  {len(times)} messages in {len(chunks)} chunks, {(times[-1] - times[0]) / 1e9:.1f} s; "
          f"attached: {', '.join(names)}")
    for topic, number in sorted(many.items()):
        channel = next(c for c in channels.values() if c.topic == topic)
        print(f"  {number:7} {topic} {schemas[channel.schema_id].name}")
    print(f"  verdict: {notes['twin.verdict']}")
    print(f"  cut at 60 %: {kept} messages read, {wanted} in {whole} whole chunks ({damage!r:.60})")
    compared = None if ros else published(schemas)
    if compared:
        same, other = compared
        print(f"  as published: {', '.join(same)}; not: {', '.join(other) or 'none'}")
        assert not other and same, other


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    for path in sys.argv[1:]:
        check(path)
