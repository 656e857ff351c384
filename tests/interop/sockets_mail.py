"""socket.smtp against a sink that writes the session down, socket.ftp against pyftpdlib."""

import tempfile
import threading
from pathlib import Path

from pyftpdlib.authorizers import DummyAuthorizer
from pyftpdlib.handlers import FTPHandler
from pyftpdlib.log import config_logging
from pyftpdlib.servers import ThreadedFTPServer

import sockets


def smtp_sink(replies, sessions):
    """Answers commands by their first word; `replies` overrides the usual answers, and None hangs up."""
    usual = {'EHLO': '250-sink\r\n250-SIZE 1000\r\n250 AUTH LOGIN PLAIN', 'MAIL': '250 ok', 'RCPT': '250 ok', 'DATA': '354 go on',
             '.': '250 taken', 'QUIT': '221 bye', 'AUTH': '334 VXNlcm5hbWU6', 'greeting': '220 sink'}
    answers = {**usual, **replies}

    def handle(connection):
        lines, file = [], connection.makefile('rwb')
        sessions.append(lines)

        def say(what):
            if answers[what] is None:
                raise OSError
            file.write(answers[what].encode() + b'\r\n')
            file.flush()

        say('greeting')
        in_data, secrets = False, 0
        while line := file.readline():
            text = line.decode().removesuffix('\r\n')
            lines.append(text)
            if in_data:
                if text == '.':
                    in_data = False
                    say('.')
            elif secrets:
                secrets -= 1
                file.write(b'334 UGFzc3dvcmQ6\r\n' if secrets else b'235 welcome\r\n')
                file.flush()
            else:
                word = text.split()[0]
                in_data = word == 'DATA' and answers['DATA'].startswith('354')
                secrets = 2 if word == 'AUTH' else 0
                say(word)

    return sockets.listen(handle)


def ftp_server(folder):
    authorizer = DummyAuthorizer()
    authorizer.add_user('user', 'p@ss', folder, perm='elradfmwMT')
    authorizer.add_user('ftp', 'anonymous@anonymous.org', folder)
    config_logging(level='ERROR')

    class Handler(FTPHandler):
        pass

    Handler.authorizer = authorizer
    server = ThreadedFTPServer(('127.0.0.1', 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return server.address[1]


def odd_ftp(command):
    """Hangs up when it gets `command`, or points elsewhere when asked for a place to send data to."""

    def handle(connection):
        file = connection.makefile('rwb')
        file.write(b'220-many\r\n lines\r\n220 ready\r\n')
        file.flush()
        while line := file.readline():
            word = line.split()[0].decode().upper()
            if word == command:
                return
            file.write({'USER': b'331 password', 'PASS': b'230 in', 'PASV': b'227 nonsense'}.get(word, b'500 what?') + b'\r\n')
            file.flush()

    return sockets.listen(handle)


def main():
    sessions = []
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / 'file.txt').write_bytes(b'line 1\r\nline 2\r\n')
        (Path(folder) / 'large').write_bytes(b'y' * 3_000_000)
        sockets.run(
            'sockets_mail.lua', smtp=smtp_sink({}, sessions), refusing=smtp_sink({'RCPT': '550 who?'}, []),
            vanishing=smtp_sink({'.': None}, []), rude=smtp_sink({'greeting': 'hello?'}, []), ftp=ftp_server(folder),
            odd=odd_ftp('NONE'), gone=odd_ftp('PASV'), closed=sockets.free_port())
        assert (Path(folder) / 'put.txt').read_bytes() == b'sent by ftp'
    mail, multipart = sessions
    assert mail == [
        'EHLO localhost', 'AUTH LOGIN', 'dXNlcg==', 'cEBzcw==', 'MAIL FROM:<me@example.org>', 'RCPT TO:<a@example.org>',
        'RCPT TO:<b@example.org>', 'DATA', 'Content-Type: text/plain; charset="iso-8859-1"', 'Date: today', 'MIME-Version: 1.0',
        'Subject: Test', 'X-Mailer: LuaSocket 3.0.0', '', 'Hello', '..dots', '.', 'QUIT'], mail
    text = '\n'.join(multipart)
    assert 'Content-Type: multipart/mixed; boundary=' in text and 'before\n' in text and 'aGVsbG8=' in text, text


main()
