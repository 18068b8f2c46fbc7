#!/usr/bin/env python3
"""Offers a stream of Haptic Wall to the Lab Streaming Layer, one channel a column.

    hapticwall run tap --realtime --stream - | ./to_lsl.py [SOURCE_ID [SECONDS]]

Waits up to SECONDS (10) for the first inlet, and at the end as long for the last to leave: an
outlet that is gone takes what it has not sent yet with it. Needs: pip install pylsl
"""
import json
import sys
import time

import pylsl

source_id = sys.argv[1] if len(sys.argv) > 1 else "hapticwall"
wait_s = float(sys.argv[2]) if len(sys.argv) > 2 else 10.0
outlet = None
for line in sys.stdin:
    sample = json.loads(line)
    if "end" in sample:
        break
    if outlet is None:
        info = pylsl.StreamInfo("hapticwall", "Haptics", len(sample), pylsl.IRREGULAR_RATE,
                                pylsl.cf_double64, source_id)
        channels = info.desc().append_child("channels")
        for name in sample:
            channels.append_child("channel").append_child_value("label", name)
        outlet = pylsl.StreamOutlet(info)
        outlet.wait_for_consumers(wait_s)
    outlet.push_sample(list(sample.values()))
end = time.monotonic() + wait_s
while outlet is not None and outlet.have_consumers() and time.monotonic() < end:
    time.sleep(0.01)
