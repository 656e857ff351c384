"""socket against plain peers in Python: echo, UDP, local sockets, and peers that are slow, silent, rude or gone."""

import os
import socket
import struct
import tempfile
import threading
import time

import sockets


def echo(connection):
    while data := connection.recv(65536):
        connection.sendall(data)


def slow(connection):
    for byte in b'slow line\nrest':
        connection.sendall(bytes([byte]))
        time.sleep(0.005)


def reset(connection):
    connection.sendall(b'part')
    connection.recv(1)
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack('ii', 1, 0))


def lines(connection):
    connection.sendall(b''.join(b'line %d\r\n' % i for i in range(100_000)))


def udp_echo():
    server = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    server.bind(('127.0.0.1', 0))

    def serve():
        while True:
            data, peer = server.recvfrom(65536)
            server.sendto(data.upper(), peer)

    threading.Thread(target=serve, daemon=True).start()
    return server.getsockname()[1]


def unix_echo(path, kind):
    server = socket.socket(socket.AF_UNIX, kind)
    server.bind(path)

    def serve_stream():
        server.listen()
        while True:
            connection, _ = server.accept()
            with connection:
                echo(connection)

    def serve_datagrams():
        while True:
            data, peer = server.recvfrom(65536)
            if peer:
                server.sendto(data.upper(), peer)

    target = serve_stream if kind == socket.SOCK_STREAM else serve_datagrams
    threading.Thread(target=target, daemon=True).start()


def main():
    with tempfile.TemporaryDirectory() as folder:
        stream, datagram = os.path.join(folder, 'stream'), os.path.join(folder, 'datagram')
        unix_echo(stream, socket.SOCK_STREAM)
        unix_echo(datagram, socket.SOCK_DGRAM)
        sockets.run(
            'sockets_peers.lua', echo=sockets.listen(echo), slow=sockets.listen(slow), reset=sockets.listen(reset),
            gone=sockets.listen(lambda connection: None), silent=sockets.listen(lambda connection: connection.recv(1)),
            lines=sockets.listen(lines), huge=sockets.listen(lambda connection: connection.sendall(b'x' * 20_000_000 + b'\nend\n')),
            udp=udp_echo(), closed=sockets.free_port(), stream=stream, datagram=datagram, folder=folder)


main()
