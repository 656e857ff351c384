//! Runs with programs and devices outside: what they send is in the capture, and nobody is asked in the replay.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};

use serde_json::json;
use serialport::{SerialPort, TTYPort};
use test_support::process::{LIMIT, wait_within};

use super::{Bench, replay, text};
use crate::view::page::Page;
use crate::view::served::Served;

/// A captured run that a test talks to.
struct Talk {
    bench: Bench,
    child: Child,
    out: BufReader<ChildStdout>,
    /// What was printed so far.
    printed: String,
}

impl Talk {
    fn start(code: &str, args: &[&str]) -> Self {
        let bench = Bench::new(&[("scene.lua", code)]);
        let mut command = bench.swanilda(args);
        command.arg("--capture").arg(bench.capture());
        let mut child = command
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("the program starts");
        let out = BufReader::new(child.stdout.take().expect("it is piped"));
        Self {
            bench,
            child,
            out,
            printed: String::new(),
        }
    }

    /// What stands behind that word in the next line that begins with it.
    fn after(&mut self, word: &str) -> String {
        loop {
            let mut line = String::new();
            let count = self.out.read_line(&mut line).expect("it is text");
            assert!(count > 0, "it ended without '{word}':\n{}", self.printed);
            self.printed.push_str(&line);
            if let Some(rest) = line.strip_prefix(word) {
                return rest.trim().to_owned();
            }
        }
    }

    /// Waits for the end, and replays: the same lines.
    fn replays(mut self) {
        self.out
            .read_to_string(&mut self.printed)
            .expect("it is text");
        let status = wait_within(&mut self.child, LIMIT).expect("it ends");
        assert!(status.success(), "{status}: {}", self.printed);
        let capture = self.bench.capture();
        let folder = self.bench.without_scene();
        same(&capture, &self.printed);
        drop(folder);
    }
}

/// A replay prints that, and says that all was the same.
fn same(capture: &Path, printed: &str) {
    let again = replay(capture, &[]);
    let said = text(&again.stderr);
    assert_eq!(text(&again.stdout), printed, "{said}");
    assert!(said.ends_with("as in the capture, to the end\n"), "{said}");
    assert_eq!(again.status.code(), Some(0));
}

#[test]
fn a_client_of_a_socket() {
    let code = "
        sim = require 'sim'
        local socket = require 'socket'
        function sysCall_init()
            server = assert(socket.bind('127.0.0.1', 0))
            print('port', (select(2, server:getsockname())))
        end
        function sysCall_actuation()
            if isOver then return end
            local client = server:accept()
            local line = client:receive()
            print('received', line, client:getpeername())
            client:send('yes, ' .. line .. '\\n')
            client:close()
            isOver = line == 'three'
            if isOver then sim.stopSimulation() end
        end";
    let mut talk = Talk::start(code, &["run", "scene.lua"]);
    let port = talk.after("port, ");
    for word in ["one", "two", "three"] {
        let mut peer = TcpStream::connect(format!("127.0.0.1:{port}")).expect("it listens");
        peer.write_all(format!("{word}\n").as_bytes())
            .expect("it reads");
        let mut answer = String::new();
        peer.read_to_string(&mut answer).expect("it is text");
        assert_eq!(answer, format!("yes, {word}\n"));
    }
    talk.replays();
}

#[test]
fn requests_of_a_web_page() {
    let code = "
        sim = require 'sim'
        simWS = require 'simWS'
        function sysCall_init()
            server = simWS.start(0)
            simWS.setHTTPHandler(server, function(_, connection, resource, data)
                print('asked', resource, tostring(data), sim.getSimulationTime())
                if resource == '/end' then sim.stopSimulation() end
                return 200, 'at ' .. sim.getSimulationTime()
            end)
            print('port', simWS.getPort(server))
        end";
    let mut talk = Talk::start(code, &["run", "scene.lua", "--realtime"]);
    let port = talk.after("port, ");
    for resource in ["/a?b", "/c", "/end"] {
        let mut peer = TcpStream::connect(format!("127.0.0.1:{port}")).expect("it listens");
        let request = format!("GET {resource} HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n");
        peer.write_all(request.as_bytes()).expect("it reads");
        let mut answer = String::new();
        peer.read_to_string(&mut answer).expect("it is text");
        assert!(answer.contains("at "), "{answer}");
        talk.after("asked, ");
    }
    talk.replays();
}

#[test]
fn zeromq_between_scripts_and_a_busy_port() {
    let code = "
        sim = require 'sim'
        simZMQ = require 'simZMQ'
        simZMQ.__raiseErrors(true)
        function sysCall_init()
            context = simZMQ.ctx_new()
            server = simZMQ.socket(context, simZMQ.REP)
            simZMQ.bind(server, 'tcp://127.0.0.1:*')
            local _, place = simZMQ.getsockopt(server, simZMQ.LAST_ENDPOINT, 100)
            place = place:gsub('%z.*', '')
            print('place', place)
            print(pcall(simZMQ.bind, simZMQ.socket(context, simZMQ.REP), place))
            client = simZMQ.socket(context, simZMQ.REQ)
            simZMQ.connect(client, place)
        end
        function sysCall_actuation()
            simZMQ.send(client, 'hello ' .. sim.getSystemTime(), 0)
            print(simZMQ.recv(server, 0))
            simZMQ.send(server, 'you', 0)
            print(simZMQ.recv(client, 0))
        end
        function sysCall_cleanup()
            simZMQ.close(client)
            simZMQ.close(server)
        end";
    let talk = Talk::start(code, &["run", "scene.lua", "--steps", "4"]);
    talk.replays();
}

#[test]
fn a_device_at_a_serial_port() {
    let (mut device, line) = TTYPort::pair().expect("the system has pseudo-terminals");
    let path = line.name().expect("the line has a name");
    let code = format!(
        "sim = require 'sim'
        function sysCall_init()
            port = sim.serialOpen('{path}', 115200)
            print('open', port)
        end
        function sysCall_actuation()
            local got = sim.serialRead(port, 100, true, '\\n', 10)
            print('got', got, sim.serialCheck(port), sim.serialSend(port, 'ok\\n'))
            if got and tostring(got):find 'end' then sim.stopSimulation() end
        end"
    );
    let mut talk = Talk::start(&code, &["run", "scene.lua"]);
    talk.after("open, ");
    for word in ["one\n", "two\n", "end\n"] {
        device.write_all(word.as_bytes()).expect("the line is open");
        talk.after("got, ");
    }
    let drain = std::thread::spawn(move || {
        // The script's answers need room.
        let mut room = [0; 64];
        while device.read(&mut room).is_ok_and(|count| count > 0) {}
    });
    talk.replays();
    drop(line);
    drain.join().expect("it does not panic");
}

#[test]
fn a_program_that_a_script_runs() {
    let code = "
        sim = require 'sim'
        simSubprocess = require 'simSubprocess'
        function sysCall_init()
            print(simSubprocess.exec('sh', {'-c', 'cat; date +%N; exit 3'}, 'input'))
            local program = simSubprocess.execAsync('sh', {'-c', 'exit 4'})
            print(simSubprocess.wait(program, 20), pcall(simSubprocess.exec, '/nowhere', {}))
            sim.launchExecutable('true')
            print(pcall(sim.launchExecutable, '/nowhere'))
        end";
    Talk::start(code, &["run", "scene.lua", "--steps", "2"]).replays();
}

#[test]
fn what_persons_do_in_pages_and_windows() {
    let scene = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/panel.lua"))
        .expect("the scene is there");
    let folder = tempfile::tempdir().expect("a folder");
    let capture = folder.path().join("run.swc");
    let name = capture.to_string_lossy().into_owned();
    let options = ["--paused", "--capture", &name];
    let mut served = Served::start(&scene, &options);
    let mut page = Page::open(&served);
    let windows = page.wait_for(|message| message.to_string().contains("Oscillator"));
    let click = json!({"type": "click", "widget": 1});
    for request in [
        json!({"do": "run", "code": "return 7"}),
        json!({"do": "run", "code": "print('from a page', sim.getSystemTime())"}),
        json!({"do": "step", "count": 3}),
        json!({"do": "ui", "window": 1, "widget": 5, "input": click}),
        json!({"do": "play"}),
        json!({"do": "speed", "factor": 0}),
    ] {
        let answer = page.ask(request.clone());
        if request["do"] != "ui" {
            assert!(answer.is_ok(), "{request}: {answer:?}\n{windows}");
        }
    }
    page.wait_for(|message| message.to_string().contains("time"));
    served.interrupt();
    served.wait();
    let again = replay(&capture, &[]);
    let said = text(&again.stderr);
    assert!(said.ends_with("as in the capture, to the end\n"), "{said}");
    assert!(text(&again.stdout).contains("from a page"));
}

/// Scripts in Python run in a process of their own, of which a replay needs none.
#[test]
fn a_script_in_python() {
    if !Command::new("python3")
        .arg("--version")
        .output()
        .is_ok_and(|output| output.status.success())
    {
        return test_support::skipped_outside_of_ci("there is no python3");
    }
    let code = "#python
import os, random, time

def sysCall_init():
    global sim
    sim = require('sim')
    print('process', os.getpid(), time.time(), os.urandom(4))

def sysCall_actuation():
    print('time', time.time(), sim.getSimulationTime())

def sysCall_thread():
    while True:
        print('thread', time.perf_counter())
        sim.step()
";
    let bench = Bench::new(&[("scene.py", code)]);
    let first = bench.run(&["run", "scene.py", "--steps", "4"]);
    let printed = text(&first.stdout);
    assert!(
        printed.contains("process") && printed.contains("thread"),
        "{printed}{}",
        text(&first.stderr)
    );
    let capture = bench.capture();
    let _folder = bench.without_scene();
    same(&capture, &printed);
}
