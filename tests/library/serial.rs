//! Serial ports, at both ends of pseudo-terminals.
#![cfg(unix)]

use serialport::{SerialPort, TTYPort};
use std::io::{Read, Write};
use swanilda::scene::Data;
use swanilda::{Options, ScriptKind, ScriptRef, SimulationState, Simulator};
use test_support::process::{LIMIT, wait_until};

/// A script that does what it is told, at once or in its thread.
const SCRIPT: &str = "
    sim = require 'sim'
    function run(code) return load(code)() end
    function sysCall_thread()
        while true do
            if job then done = job() job = nil end
            sim.step()
        end
    end";

/// A simulator with one script, and a device on a pseudo-terminal whose other end the test holds.
struct Bench {
    sim: Simulator,
    script: ScriptRef,
    device: TTYPort,
    /// Open, so that the device stays while the script has it closed.
    line: TTYPort,
    path: String,
}

impl Bench {
    fn new() -> Self {
        let mut sim = Simulator::new(Options::default());
        let script = add_script(&mut sim, SCRIPT);
        let (device, line) = TTYPort::pair().expect("the system has pseudo-terminals");
        let path = line.name().expect("the line has a name");
        Self {
            sim,
            script,
            device,
            line,
            path,
        }
    }

    /// One with the port open as the global `h`.
    fn open() -> Self {
        let mut bench = Self::new();
        assert_eq!(
            bench.run("h = sim.serialOpen(PATH, 115200) return h"),
            [Data::Int(1)]
        );
        bench
    }

    fn run(&mut self, code: &str) -> Vec<Data> {
        let code = code.replace("PATH", &format!("'{}'", self.path));
        let results = self.sim.call(&self.script, "run", &[Data::text(&code)]);
        results.unwrap_or_else(|error| panic!("{code}: {error}"))
    }

    fn fails(&mut self, code: &str) -> bool {
        self.run(&format!("return (pcall(function() {code} end))")) == [Data::Bool(false)]
    }

    fn text(&mut self, code: &str) -> String {
        match &self.run(code)[..] {
            [Data::Text(bytes)] => String::from_utf8_lossy(bytes).into_owned(),
            other => panic!("{code}: {other:?}"),
        }
    }

    /// Returns when the bytes have gone through the line.
    fn device_sends(&mut self, bytes: &[u8]) {
        let waiting = |line: &TTYPort| line.bytes_to_read().expect("the line is there") as usize;
        let before = waiting(&self.line);
        self.device.write_all(bytes).expect("the line takes it");
        wait_until("the bytes arrive", || {
            waiting(&self.line) >= before + bytes.len()
        });
    }

    fn device_gets(&mut self, count: usize) -> Vec<u8> {
        let mut bytes = vec![0; count];
        self.device
            .set_timeout(LIMIT)
            .expect("a time-out can be set");
        self.device
            .read_exact(&mut bytes)
            .expect("the script has sent it");
        bytes
    }

    /// Passes until `code` gives something else than nil.
    fn pass_until(&mut self, code: &str) -> Vec<Data> {
        for _ in 0..100_000 {
            self.sim.iterate();
            let answer = self.run(code);
            if answer != [Data::Nil] {
                return answer;
            }
        }
        panic!("{code} is still nil");
    }
}

fn add_script(sim: &mut Simulator, code: &str) -> ScriptRef {
    sim.add_script(ScriptKind::Customization, "script", code.as_bytes())
        .expect("the script loads")
}

/// Makes the thread read once; `done` is what it got.
fn read_in_thread(arguments: &str) -> String {
    format!("done = nil job = function() return sim.serialRead(h, {arguments}) end")
}

#[test]
fn what_cannot_be_opened() {
    let mut bench = Bench::new();
    for port in [
        "'/dev/does_not_exist', 9600",
        "'/dev/null', 9600",
        "'/', 9600",
        "'', 9600",
        "'a\\0b', 9600",
    ] {
        assert_eq!(
            bench.run(&format!("return sim.serialOpen({port})")),
            [Data::Int(-1)],
            "{port}"
        );
    }
    for rate in ["12345", "0", "-9600", "1 << 62"] {
        assert_eq!(
            bench.run(&format!("return sim.serialOpen(PATH, {rate})")),
            [Data::Int(-1)],
            "{rate}"
        );
    }
    assert_eq!(
        bench.run("return sim.serialOpen(PATH, 115200)"),
        [Data::Int(1)]
    );
    assert_eq!(
        bench.run("return sim.serialOpen(PATH, 115200)"),
        [Data::Int(-1)],
        "it is open already"
    );
    assert_eq!(
        bench.run("sim.serialClose(1) return sim.serialOpen(PATH, 9600)"),
        [Data::Int(2)]
    );
    for arguments in ["", "PATH", "9600, 9600", "PATH, '9600'", "PATH, 9600, 1"] {
        assert!(
            bench.fails(&format!("sim.serialOpen({arguments})")),
            "{arguments}"
        );
    }
}

#[test]
fn bytes_go_both_ways() {
    let mut bench = Bench::open();
    assert_eq!(bench.run("return sim.serialSend(h, 'abc')"), [Data::Int(3)]);
    assert_eq!(bench.device_gets(3), b"abc");
    assert_eq!(bench.run("return sim.serialSend(h, '')"), [Data::Int(-5)]);
    bench.device_sends(b"hello");
    assert_eq!(bench.run("return sim.serialCheck(h)"), [Data::Int(5)]);
    assert_eq!(bench.text("return sim.serialRead(h, 3, false)"), "hel");
    assert_eq!(bench.text("return sim.serialRead(h, 10, false)"), "lo");
    assert_eq!(bench.text("return sim.serialRead(h, 10)"), "");
    assert_eq!(
        bench.text("return simSerialRead(h, -1)"),
        "",
        "the old name"
    );
}

#[test]
fn every_byte_arrives_as_it_was() {
    let mut bench = Bench::open();
    let all: Vec<u8> = (0..=255).collect();
    bench.run("all = '' for i = 0, 255 do all = all .. string.char(i) end sim.serialSend(h, tobuffer(all))");
    assert_eq!(bench.device_gets(256), all);
    bench.device_sends(&all);
    bench.device_sends(b"\0\xff");
    assert_eq!(
        bench.run("return sim.serialRead(h, 258) == all .. '\\0\\255'"),
        [Data::Bool(true)]
    );
}

#[test]
fn a_thread_reads_up_to_a_closing_string_while_the_simulation_goes_on() {
    let mut bench = Bench::open();
    bench.sim.start();
    bench.run(&read_in_thread("100, true, '\\n'"));
    for byte in b"ab" {
        bench.device_sends(&[*byte]);
        bench.sim.step(2);
        assert_eq!(bench.run("return done"), [Data::Nil]);
    }
    let time = bench.sim.time();
    bench.device_sends(b"\ncd");
    assert_eq!(bench.pass_until("return done"), [Data::text("ab\n")]);
    assert!(bench.sim.time() > time);
    assert_eq!(bench.text("return sim.serialRead(h, 10)"), "cd");
}

#[test]
fn a_thread_reads_exactly_so_many_bytes() {
    let mut bench = Bench::open();
    bench.sim.start();
    bench.run(&read_in_thread("4, true"));
    for part in [b"ab".as_slice(), b"cdef"] {
        assert_eq!(bench.run("return done"), [Data::Nil]);
        bench.sim.iterate();
        bench.device_sends(part);
    }
    assert_eq!(bench.pass_until("return done"), [Data::text("abcd")]);
    assert_eq!(bench.text("return sim.serialRead(h, 4)"), "ef");
    assert!(bench.sim.time() > 0.0);
}

#[test]
fn a_time_out_ends_a_read_with_what_there_is() {
    let mut bench = Bench::open();
    bench.device_sends(b"xy");
    bench.run(&read_in_thread("100, true, '', 0.3"));
    assert_eq!(bench.pass_until("return done"), [Data::text("xy")]);
    assert_eq!(bench.text("return sim.serialRead(h, 10)"), "");
    assert_eq!(
        bench.text("return sim.serialRead(h, 10, true, 'z', 0.05)"),
        "",
        "outside of a thread too"
    );
}

#[test]
fn unknown_handles_are_errors() {
    let mut bench = Bench::open();
    for call in [
        "sim.serialSend(9999, 'x')",
        "sim.serialCheck(9999)",
        "sim.serialClose(9999)",
        "sim.serialRead(9999, 1)",
    ] {
        assert!(bench.fails(call), "{call}");
    }
    bench.run("sim.serialClose(h)");
    for call in [
        "sim.serialSend(h, 'x')",
        "sim.serialCheck(h)",
        "sim.serialClose(h)",
        "sim.serialRead(h, 1)",
    ] {
        assert!(bench.fails(call), "{call} after it was closed");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn the_end_of_the_simulation_closes_ports() {
    let mut bench = Bench::open();
    for run in 2..5 {
        bench.sim.step(2);
        bench.sim.stop();
        assert_eq!(
            descriptors(&bench.path),
            1,
            "the port is closed, the test's end of the line is open"
        );
        assert_eq!(
            bench.run("return pcall(sim.serialCheck, h)")[0],
            Data::Bool(false)
        );
        assert_eq!(
            bench.run("h = sim.serialOpen(PATH, 9600) return h"),
            [Data::Int(run)]
        );
        assert_eq!(descriptors(&bench.path), 2);
    }
    drop((bench.sim, bench.script));
    assert_eq!(
        descriptors(&bench.path),
        1,
        "the end of the simulator closes it as well"
    );
}

/// How many descriptors of a device this process has open.
#[cfg(target_os = "linux")]
fn descriptors(path: &str) -> usize {
    let entries = std::fs::read_dir("/proc/self/fd")
        .expect("descriptors can be listed")
        .flatten();
    entries
        .filter_map(|entry| std::fs::read_link(entry.path()).ok())
        .filter(|link| link.as_os_str() == path)
        .count()
}

#[test]
fn a_device_that_vanishes() {
    let mut bench = Bench::open();
    bench.run(&read_in_thread("100, true, '\\n', 0.05"));
    let (other, _) = TTYPort::pair().expect("the system has pseudo-terminals");
    drop(std::mem::replace(&mut bench.device, other));
    assert_eq!(
        bench.run("return sim.serialSend(h, 'anybody?')"),
        [Data::Int(-1)]
    );
    assert_eq!(bench.run("return sim.serialCheck(h)"), [Data::Int(-1)]);
    bench.sim.start();
    assert_eq!(bench.pass_until("return done"), [Data::text("")]);
    assert_eq!(bench.text("return sim.serialRead(h, 100)"), "");
    bench.run("sim.serialClose(h)");
}

#[test]
fn a_device_that_takes_nothing_does_not_hold_the_simulator() {
    let mut bench = Bench::open();
    let sent = bench.run("return sim.serialSend(h, ('x'):rep(1 << 20))");
    let [Data::Int(sent)] = sent[..] else {
        panic!("{sent:?}")
    };
    assert!((1..1 << 20).contains(&sent), "{sent}");
    assert_eq!(bench.device_gets(sent as usize), vec![b'x'; sent as usize]);
}

#[test]
fn two_scripts_talk_over_a_line() {
    let mut bench = Bench::open();
    let (mut far, far_line) = TTYPort::pair().expect("the system has pseudo-terminals");
    let code = format!(
        "sim = require 'sim'
        h = sim.serialOpen('{}', 9600)
        function sysCall_thread()
            for i = 1, 20 do sim.serialSend(h, 'pong ' .. sim.serialRead(h, 100, true, '\\n')) end
        end",
        far_line.name().expect("the line has a name")
    );
    add_script(&mut bench.sim, &code);
    bench.run(
        "got = {}
        job = function()
            for i = 1, 20 do
                sim.serialSend(h, 'ping ' .. i .. '\\n')
                got[i] = sim.serialRead(h, 100, true, '\\n')
            end
        end",
    );
    bench.sim.start();
    let mut passes = 0;
    while bench.run("return #got") != [Data::Int(20)] {
        bench.sim.iterate();
        carry(&mut bench.device, &mut far);
        carry(&mut far, &mut bench.device);
        passes += 1;
        assert!(passes < 10_000, "the scripts do not talk");
    }
    assert_eq!(
        bench.text("return got[1] .. got[20]"),
        "pong ping 1\npong ping 20\n"
    );
}

#[test]
fn the_bridge_scene_obeys_its_device() {
    let (mut device, line) = TTYPort::pair().expect("the system has pseudo-terminals");
    let path = line.name().expect("the line has a name");
    let named_params = [("port".to_owned(), path)].into();
    let mut sim = Simulator::new(Options {
        named_params,
        ..Options::default()
    });
    add_script(&mut sim, include_str!("../../scenes/serial_bridge.lua"));
    sim.start();
    sim.step(2);
    device
        .write_all(b"speed 2\nnonsense\n")
        .expect("the line takes it");
    let (mut said, mut passes) = (String::new(), 0);
    while !said.lines().any(|line| {
        line.strip_prefix("angle ")
            .is_some_and(|angle| angle != "0.000")
    }) {
        sim.iterate();
        let mut bytes = vec![0; device.bytes_to_read().expect("the device is there") as usize];
        device.read_exact(&mut bytes).expect("they are there");
        said += &String::from_utf8_lossy(&bytes);
        passes += 1;
        assert!(passes < 100_000, "the motor does not move: {said}");
    }
    device.write_all(b"stop\n").expect("the line takes it");
    while sim.state() != SimulationState::Stopped {
        sim.iterate();
        passes += 1;
        assert!(passes < 200_000, "the simulation does not stop");
    }
    assert_eq!(sim.errors(), 0);
}

/// The wire between two devices.
fn carry(from: &mut TTYPort, to: &mut TTYPort) {
    let mut bytes = vec![0; from.bytes_to_read().expect("the device is there") as usize];
    from.read_exact(&mut bytes).expect("they are there");
    to.write_all(&bytes).expect("the line takes it");
}
