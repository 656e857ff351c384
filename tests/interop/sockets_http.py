"""socket.http and ssl.https against Python's HTTP server, and against servers that do what none should."""

import base64
import http.server
import ssl
import tempfile
import threading
import time
from pathlib import Path

import trustme

import sockets


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = 'HTTP/1.1'

    def log_message(self, *_):
        pass

    def answer(self, code, body, **headers):
        self.send_response(code)
        for name, value in headers.items():
            self.send_header(name.replace('_', '-'), value)
        self.send_header('Content-Length', str(len(body)))
        self.end_headers()
        if self.command != 'HEAD':
            self.wfile.write(body)

    def do_GET(self):
        if self.path.startswith('http://'):
            return self.answer(200, f'proxied {self.path} {self.headers["Proxy-Authorization"]}'.encode())
        name, _, rest = self.path.lstrip('/').partition('/')
        getattr(self, 'get_' + name, self.get_missing)(rest)

    do_HEAD = do_GET

    def do_POST(self):
        if self.headers.get('Transfer-Encoding') == 'chunked':
            body = b''
            while size := int(self.rfile.readline(), 16):
                body += self.rfile.read(size)
                self.rfile.readline()
            self.rfile.readline()
        else:
            body = self.rfile.read(int(self.headers['Content-Length']))
        self.answer(200, b'got ' + body, X_Type=self.headers.get('Content-Type', 'none'))

    do_PUT = do_POST

    def get_plain(self, _):
        self.answer(200, b'hello world', X_Twice='a', Content_Type='text/plain')

    def get_large(self, size):
        self.answer(200, b'x' * int(size))

    def get_headers(self, name):
        self.answer(200, str(self.headers.get(name)).encode())

    def get_redirect(self, count):
        target = f'/redirect/{int(count) - 1}' if int(count) else '/plain'
        self.answer(302, b'elsewhere', Location=target)

    def get_elsewhere(self, url):
        self.answer(301, b'', Location=url)

    def get_chunked(self, _):
        self.send_response(200)
        self.send_header('Transfer-Encoding', 'chunked')
        self.end_headers()
        self.wfile.write(b'5\r\nhello\r\n6;name=value\r\n world\r\n0\r\nX-Trailer: late\r\n\r\n')

    def get_closing(self, _):
        self.send_response(200)
        self.send_header('Connection', 'close')
        self.end_headers()
        self.wfile.write(b'until closed')
        self.close_connection = True

    def get_nothing(self, _):
        self.send_response(204)
        self.end_headers()

    def get_secret(self, _):
        wanted = 'Basic ' + base64.b64encode(b'user:p@ss').decode()
        ok = self.headers.get('Authorization') == wanted
        self.answer(200 if ok else 401, b'come in' if ok else b'who are you?')

    def get_missing(self, _):
        self.answer(404, b'not here')


class Server(http.server.ThreadingHTTPServer):
    def handle_error(self, *_):
        """Clients of these tests go when they like."""


def http_server(context=None):
    server = Server(('127.0.0.1', 0), Handler)
    if context:
        server.socket = context.wrap_socket(server.socket, server_side=True)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return server.server_address[1]


def odd_server():
    """The path of the request says what goes wrong."""

    def handle(connection):
        request = b''
        while b'\r\n\r\n' not in request:
            data = connection.recv(4096)
            if not data:
                return
            request += data
        what = request.split()[1].decode().strip('/')
        head = b'HTTP/1.1 200 OK\r\n'
        chunked = head + b'Transfer-Encoding: chunked\r\n\r\n'
        if what == 'endless-headers':
            connection.sendall(head)
            for i in range(1 << 20):
                connection.sendall(b'X-%d: y\r\n' % i)
        elif what == 'endless-line':
            connection.sendall(head + b'X: ' + b'y' * (1 << 20) + b'\r\n\r\n')
        elif what == 'slow':
            for byte in head + b'Content-Length: 2\r\n\r\nok':
                connection.sendall(bytes([byte]))
                time.sleep(0.001)
        elif what == 'silent':
            connection.recv(1)
        else:
            connection.sendall({
                'gone': b'',
                'gone-in-status': b'HTTP/1.1 20',
                'gone-in-headers': head + b'Content-Le',
                'gone-in-body': head + b'Content-Length: 10\r\n\r\nhalf',
                'gone-in-chunk': chunked + b'a\r\nhalf',
                'gone-before-chunk': chunked,
                'bad-status': b'HTTP/1.1 what\r\n\r\n',
                'bad-header': head + b'no colon\r\n\r\n',
                'bad-chunk': chunked + b'xyz\r\nhello\r\n0\r\n\r\n',
                'huge-chunk': chunked + b'ffffffffffffffffff\r\nhello',
                'bad-length': head + b'Content-Length: many\r\n\r\nbody',
                'folded': head + b'X-Long: one\r\n two\r\nx-long: three\r\nContent-Length: 0\r\n\r\n',
                'continue': b'HTTP/1.1 100 Continue\r\n\r\n' + head + b'Content-Length: 2\r\n\r\nok',
                'http10': b'HTTP/1.0 200 OK\r\n\r\nten',
                'http09': b'<html>of 1991</html>',
            }[what])

    return sockets.listen(handle)


def main():
    authority = trustme.CA()
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder) / 'root.pem'
        authority.cert_pem.write_to_path(root)
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        certificate = authority.issue_cert('127.0.0.1', 'localhost')
        certificate.configure_cert(context)
        own, key = Path(folder) / 'own.pem', Path(folder) / 'key.pem'
        certificate.cert_chain_pems[0].write_to_path(own)
        certificate.private_key_pem.write_to_path(key)
        wrong_name = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        authority.issue_cert('elsewhere.example').configure_cert(wrong_name)
        sockets.run('sockets_http.lua', http=http_server(), https=http_server(context), wrong=http_server(wrong_name),
                    odd=odd_server(), closed=sockets.free_port(), cafile=root, certificate=own, key=key)


main()
