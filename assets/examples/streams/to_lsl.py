#!/usr/bin/env python3
"""Offers a stream of Haptic Wall to the Lab Streaming Layer, one channel a column, and its events
as the markers `hapticwall-events`: one text of JSON, at the time of its tick.

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
markers = None
time_s = 0.0
for line in sys.stdin:
    sample = json.loads(line)
    if "end" in sample:
        break
    if "event" in sample:
        if markers is not None:
            stamp = pylsl.local_clock() + sample["time_s"] - time_s
            markers.push_sample([line.strip()], stamp)
        continue
    if outlet is None:
        info = pylsl.StreamInfo("hapticwall", "Haptics", len(sample), pylsl.IRREGULAR_RATE,
                                pylsl.cf_double64, source_id)
        channels = info.desc().append_child("channels")
        for name in sample:
            channels.append_child("channel").append_child_value("label", name)
        outlet = pylsl.StreamOutlet(info)
        markers = pylsl.StreamOutlet(pylsl.StreamInfo("hapticwall-events", "Markers", 1,
                                                      pylsl.IRREGULAR_RATE, pylsl.cf_string,
                                                      source_id + "-events"))
        outlet.wait_for_consumers(wait_s)
    outlet.push_sample(list(sample.values()))
    time_s = sample["time_s"]
end = time.monotonic() + wait_s
while outlet is not None and (outlet.have_consumers() or markers.have_consumers()) and time.monotonic() < end:
    time.sleep(0.01)
