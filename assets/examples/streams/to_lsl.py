#!/usr/bin/env python3
"""Offers a stream of Haptic Wall to the Lab Streaming Layer, one channel a column.

    hapticwall run tap --realtime --stream - | ./to_lsl.py [SOURCE_ID]

Waits up to ten seconds for the first inlet. Needs: pip install pylsl
"""
import json
import sys

import pylsl

outlet = None
for line in sys.stdin:
    sample = json.loads(line)
    if "end" in sample:
        break
    if outlet is None:
        source_id = sys.argv[1] if len(sys.argv) > 1 else "hapticwall"
        info = pylsl.StreamInfo("hapticwall", "Haptics", len(sample), pylsl.IRREGULAR_RATE,
                                pylsl.cf_double64, source_id)
        channels = info.desc().append_child("channels")
        for name in sample:
            channels.append_child("channel").append_child_value("label", name)
        outlet = pylsl.StreamOutlet(info)
        outlet.wait_for_consumers(10.0)
    outlet.push_sample(list(sample.values()))
