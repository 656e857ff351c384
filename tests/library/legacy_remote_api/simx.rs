//! A client of the legacy remote API, and a simulator that serves it on a thread of its own.

use std::io::{self, Read, Write};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use swanilda::{Options, ScriptKind, Simulator};
use test_support::process::LIMIT;

pub const ONESHOT: u32 = 0;
pub const BLOCKING: u32 = 1;
pub const STREAMING: u32 = 2;
pub const ONESHOT_SPLIT: u32 = 3;
pub const STREAMING_SPLIT: u32 = 4;
pub const DISCONTINUE: u32 = 5;

/// A simulator with the default scene that serves one client.
pub struct Server {
    pub address: SocketAddr,
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Server {
    /// With a customization script.
    pub fn start(code: &'static str) -> Self {
        let stop = Arc::<AtomicBool>::default();
        let (their_stop, (sender, receiver)) = (stop.clone(), mpsc::channel());
        let thread = std::thread::Builder::new()
            .stack_size(Simulator::STACK_SIZE)
            .spawn(move || {
                let mut sim = Simulator::new(Options::default());
                sim.scene_mut()
                    .add_default_objects()
                    .expect("there is room");
                sim.add_script(ScriptKind::Customization, "test", code.as_bytes())
                    .expect("there is room");
                assert_eq!(sim.errors(), 0, "the script fails");
                let listener = TcpListener::bind("127.0.0.1:0").expect("a port is free");
                sender
                    .send(sim.serve_legacy(listener).expect("the listener is good"))
                    .expect("the test waits");
                while !their_stop.load(Ordering::Relaxed) {
                    let steps = sim.steps();
                    sim.iterate();
                    if sim.steps() == steps {
                        sim.wait_for_request(Duration::from_millis(5));
                    }
                }
            });
        let thread = thread.expect("a thread can be made");
        let address = receiver.recv_timeout(LIMIT).expect("the server starts");
        Self {
            address,
            stop,
            thread: Some(thread),
        }
    }

    pub fn connect(&self) -> Client {
        Client::connect(self.address)
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        let ended = self
            .thread
            .take()
            .is_none_or(|thread| thread.join().is_ok());
        assert!(
            ended || std::thread::panicking(),
            "the simulator has panicked"
        );
    }
}

/// A command as it is sent, or as it comes back.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Command {
    pub id: u16,
    pub mode: u32,
    pub key: Vec<u8>,
    pub data: Vec<u8>,
    pub delay: u16,
    pub status: u8,
    /// Milliseconds of simulation.
    pub time: i32,
    pub offset: usize,
    pub full: usize,
}

/// A command with a key, and data that is complete.
pub fn command(id: u16, mode: u32, key: &[u8], data: &[u8]) -> Command {
    let full = 26 + key.len() + data.len();
    let (key, data) = (key.to_vec(), data.to_vec());
    Command {
        id,
        mode,
        key,
        data,
        delay: 0,
        status: 0,
        time: 0,
        offset: 0,
        full,
    }
}

impl Command {
    pub fn write(&self, bytes: &mut Vec<u8>) {
        bytes.extend((26 + self.key.len() + self.data.len()).to_le_bytes()[..4].iter());
        bytes.extend(self.full.to_le_bytes()[..4].iter());
        bytes.extend((self.key.len() as u16).to_le_bytes());
        bytes.extend(self.offset.to_le_bytes()[..4].iter());
        bytes.extend((u32::from(self.id) | self.mode << 16).to_le_bytes());
        bytes.extend(self.delay.to_le_bytes());
        bytes.extend([0; 4]);
        bytes.extend([self.status, 0]);
        bytes.extend(&self.key);
        bytes.extend(&self.data);
    }
}

/// A message of the server.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reply {
    pub bytes: Vec<u8>,
    pub id: i32,
    pub state: u8,
    pub commands: Vec<Command>,
}

pub struct Client {
    pub stream: TcpStream,
    last: i32,
}

fn int(bytes: &[u8], at: usize) -> i32 {
    i32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes"))
}

fn short(bytes: &[u8], at: usize) -> u16 {
    u16::from_le_bytes([bytes[at], bytes[at + 1]])
}

impl Client {
    pub fn connect(address: SocketAddr) -> Self {
        let stream = TcpStream::connect(address).expect("the server listens");
        stream.set_nodelay(true).expect("it is a socket");
        stream
            .set_read_timeout(Some(LIMIT))
            .expect("it is a socket");
        Self { stream, last: -1 }
    }

    /// Sends commands in one message and reads the reply.
    pub fn exchange(&mut self, commands: &[Command]) -> Reply {
        let mut message = vec![0, 0, 11];
        self.last += 1;
        message.extend(self.last.to_le_bytes());
        message.extend([0; 11]);
        commands
            .iter()
            .for_each(|command| command.write(&mut message));
        self.exchange_bytes(&packets(&message))
            .expect("the server replies")
    }

    /// Sends bytes and reads the reply.
    pub fn exchange_bytes(&mut self, bytes: &[u8]) -> io::Result<Reply> {
        self.stream.write_all(bytes)?;
        let mut message = Vec::new();
        loop {
            let mut header = [0; 6];
            self.stream.read_exact(&mut header)?;
            let start = message.len();
            message.resize(start + usize::from(short(&header, 2)), 0);
            self.stream.read_exact(&mut message[start..])?;
            if short(&header, 4) == 0 {
                return Ok(parse(message));
            }
        }
    }

    /// Exchanges messages until there is a reply to a command, as clients do in a blocking call.
    pub fn call(&mut self, sent: Command) -> Command {
        let mut reply = self.exchange(std::slice::from_ref(&sent));
        let (id, begun) = (self.last, Instant::now());
        loop {
            if reply.id >= id && !reply.commands.is_empty() {
                let found = reply
                    .commands
                    .into_iter()
                    .find(|answer| (answer.id, &answer.key) == (sent.id, &sent.key));
                return found.unwrap_or_else(|| panic!("no reply to {sent:?}"));
            }
            assert!(begun.elapsed() < LIMIT, "no reply to {sent:?}");
            reply = self.exchange(&[]);
        }
    }

    /// The data of the reply to a blocking call, which must not fail.
    pub fn get(&mut self, id: u16, key: &[u8], data: &[u8]) -> Vec<u8> {
        let answer = self.call(command(id, BLOCKING, key, data));
        assert_eq!(answer.status, 0, "{id:04x} fails: {:?}", self.errors());
        answer.data
    }

    /// Whether a blocking call fails.
    pub fn fails(&mut self, id: u16, key: &[u8], data: &[u8]) -> bool {
        self.call(command(id, BLOCKING, key, data)).status == 1
    }

    /// The handle of an object.
    pub fn handle(&mut self, name: &str) -> [u8; 4] {
        self.get(0x3001, &text(name), &[])
            .try_into()
            .expect("a handle has four bytes")
    }

    /// The texts of the last errors.
    pub fn errors(&mut self) -> Vec<String> {
        let data = self.call(command(0x0004, BLOCKING, &[], &[])).data;
        let texts = data[4..]
            .split(|&byte| byte == 0)
            .map(|text| String::from_utf8_lossy(text).into_owned());
        texts.take(int(&data, 0) as usize).collect()
    }
}

pub fn text(text: &str) -> Vec<u8> {
    [text.as_bytes(), &[0]].concat()
}

pub fn ints(values: &[i32]) -> Vec<u8> {
    values
        .iter()
        .flat_map(|value| value.to_le_bytes())
        .collect()
}

pub fn floats(values: &[f32]) -> Vec<u8> {
    values
        .iter()
        .flat_map(|value| value.to_le_bytes())
        .collect()
}

pub fn read_floats(bytes: &[u8]) -> Vec<f32> {
    bytes
        .chunks_exact(4)
        .map(|chunk| f32::from_le_bytes(chunk.try_into().expect("four bytes")))
        .collect()
}

pub fn read_ints(bytes: &[u8]) -> Vec<i32> {
    bytes
        .chunks_exact(4)
        .map(|chunk| i32::from_le_bytes(chunk.try_into().expect("four bytes")))
        .collect()
}

/// A message in packets, as the usual clients cut it.
pub fn packets(message: &[u8]) -> Vec<u8> {
    let count = message.len().div_ceil(1294);
    let cut = |(place, content): (usize, &[u8])| {
        let header = [1, content.len() as u16, (count - 1 - place) as u16];
        [header.map(u16::to_le_bytes).concat(), content.to_vec()].concat()
    };
    message.chunks(1294).enumerate().flat_map(cut).collect()
}

fn parse(bytes: Vec<u8>) -> Reply {
    let (mut commands, mut at) = (Vec::new(), 18);
    while at < bytes.len() {
        let (size, key) = (int(&bytes, at) as usize, short(&bytes, at + 8) as usize);
        let number = int(&bytes, at + 14) as u32;
        commands.push(Command {
            id: number as u16,
            mode: number >> 16,
            key: bytes[at + 26..at + 26 + key].to_vec(),
            data: bytes[at + 26 + key..at + size].to_vec(),
            delay: short(&bytes, at + 18),
            status: bytes[at + 24],
            time: int(&bytes, at + 20),
            offset: int(&bytes, at + 10) as usize,
            full: int(&bytes, at + 4) as usize,
        });
        at += size;
    }
    Reply {
        id: int(&bytes, 3),
        state: bytes[17],
        commands,
        bytes,
    }
}
