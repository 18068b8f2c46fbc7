#!/usr/bin/env python3
"""Writes a stream of Haptic Wall to an MCAP file, for Foxglove and other readers of MCAP.

    hapticwall run tap --stream - | ./to_mcap.py FILE.mcap

Messages are JSON on the topic /hapticwall, at the session's time, and the events on
/hapticwall/events. Needs: pip install mcap
"""
import json
import sys

from mcap.writer import Writer

with open(sys.argv[1], "xb") as file:
    writer = Writer(file)
    writer.start()
    channel = None
    shape = json.dumps({"type": "object", "properties": {"event": {"type": "string"}}}).encode()
    events = writer.register_channel("/hapticwall/events", "json",
                                     writer.register_schema("hapticwall.Event", "jsonschema", shape))
    for line in sys.stdin:
        sample = json.loads(line)
        if "end" in sample:
            break
        time_ns = round(sample["time_s"] * 1e9)
        if "event" in sample:
            writer.add_message(events, time_ns, line.encode(), time_ns)
            continue
        if channel is None:
            columns = {name: {"type": "number"} for name in sample}
            shape = json.dumps({"type": "object", "properties": columns}).encode()
            schema = writer.register_schema("hapticwall.Sample", "jsonschema", shape)
            channel = writer.register_channel("/hapticwall", "json", schema)
        writer.add_message(channel, time_ns, line.encode(), time_ns)
    writer.finish()
