#!/usr/bin/env python3
"""Sends a stream of Haptic Wall to PlotJuggler: one UDP datagram of JSON a sample.

    hapticwall run tap --realtime --stream - | ./to_plotjuggler.py [HOST [PORT]]

In PlotJuggler: Streaming, UDP Server, port 9870, message protocol json. Needs no package.
"""
import json
import socket
import sys

host = sys.argv[1] if len(sys.argv) > 1 else "127.0.0.1"
port = int(sys.argv[2]) if len(sys.argv) > 2 else 9870
plotter = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
for line in sys.stdin:
    sample = json.loads(line)
    if "end" in sample:
        print(f"{sample['samples']} samples, {sample['lost']} lost", file=sys.stderr)
    elif "event" not in sample:
        plotter.sendto(line.encode(), (host, port))
