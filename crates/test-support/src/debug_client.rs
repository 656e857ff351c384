//! A client of the Debug Adapter Protocol.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use serde_json::{Value, json};

/// Every answer comes within this time.
const TIMEOUT: Duration = Duration::from_secs(60);

/// A client, and the command that it has started.
pub struct Client {
    /// None for a debugger that somebody else has started.
    command: Option<Child>,
    output: Box<dyn Write + Send>,
    messages: Receiver<Value>,
    /// Messages that nobody has asked for yet.
    waiting: Vec<Value>,
    seq: i64,
}

impl Client {
    /// Starts `swanilda debug` with these arguments, on standard input and output. `program` is `swanilda`.
    ///
    /// # Panics
    /// As all functions here, when something is not as the test expects.
    pub fn start(program: &str, arguments: &[&str]) -> Self {
        let mut command = spawn(program, &[&["debug"], arguments].concat());
        let output = command.stdin.take().expect("a pipe");
        let input = command.stdout.take().expect("a pipe");
        Self::of(Some(command), input, output)
    }

    /// The same over a port.
    pub fn start_on_port(program: &str, arguments: &[&str]) -> Self {
        let arguments = [&["debug", "--port", "0"], arguments].concat();
        Self::connect(spawn(program, &arguments))
    }

    /// Connects to the address that a command prints first.
    fn connect(mut command: Child) -> Self {
        let mut line = String::new();
        let mut said = BufReader::new(command.stdout.take().expect("a pipe"));
        said.read_line(&mut line).expect("the address is printed");
        let address = line
            .trim()
            .strip_prefix("Debugger at ")
            .expect("an address");
        let stream = TcpStream::connect(address).expect("the command listens");
        let input = stream.try_clone().expect("a stream");
        // Whoever reads it no longer closes it.
        std::mem::forget(said);
        Self::of(Some(command), input, stream)
    }

    /// Connects to a debugger that listens at `host:port`.
    pub fn connected_to(address: &str) -> Self {
        let stream = TcpStream::connect(address).expect("it listens");
        let input = stream.try_clone().expect("a stream");
        Self::of(None, input, stream)
    }

    /// The same for another command that listens, `swanilda serve` for instance.
    pub fn attach(program: &str, arguments: &[&str]) -> Self {
        Self::connect(spawn(program, arguments))
    }

    fn of(
        command: Option<Child>,
        input: impl Read + Send + 'static,
        output: impl Write + Send + 'static,
    ) -> Self {
        let (sender, messages) = channel();
        std::thread::spawn(move || {
            let mut input = BufReader::new(input);
            while let Some(message) = read(&mut input) {
                if sender.send(message).is_err() {
                    return;
                }
            }
        });
        Self {
            command,
            output: Box::new(output),
            messages,
            waiting: Vec::new(),
            seq: 0,
        }
    }

    /// Writes bytes as they are.
    pub fn write(&mut self, bytes: &[u8]) {
        let _ = self
            .output
            .write_all(bytes)
            .and_then(|()| self.output.flush());
    }

    fn take(&mut self, what: &str, is_it: impl Fn(&Value) -> bool) -> Value {
        if let Some(at) = self.waiting.iter().position(&is_it) {
            return self.waiting.remove(at);
        }
        loop {
            let message = self.messages.recv_timeout(TIMEOUT);
            let message = message
                .unwrap_or_else(|error| panic!("{what}: {error}; there is {:#?}", self.waiting));
            if is_it(&message) {
                return message;
            }
            self.waiting.push(message);
        }
    }

    /// Sends a request and returns the answer.
    pub fn answer(&mut self, command: &str, arguments: Value) -> Value {
        let seq = self.send(command, arguments);
        self.answer_to(seq)
    }

    /// The answer to the request with that number.
    pub fn answer_to(&mut self, seq: i64) -> Value {
        self.take("an answer", |message| message["request_seq"] == seq)
    }

    /// Sends a request; its number.
    pub fn send(&mut self, command: &str, arguments: Value) -> i64 {
        self.seq += 1;
        let seq = self.seq;
        let request =
            json!({"seq": seq, "type": "request", "command": command, "arguments": arguments});
        let text = request.to_string();
        self.write(format!("Content-Length: {}\r\n\r\n{text}", text.len()).as_bytes());
        seq
    }

    /// The same for a request that is done; what is in the answer.
    pub fn request(&mut self, command: &str, arguments: Value) -> Value {
        let mut answer = self.answer(command, arguments);
        assert_eq!(answer["success"], true, "{command}: {answer}");
        answer["body"].take()
    }

    /// What is in the next event of that name.
    pub fn event(&mut self, name: &str) -> Value {
        self.take(name, |message| message["event"] == name)["body"].take()
    }

    /// The text of the next output that contains this.
    pub fn output(&mut self, part: &str) -> String {
        let is_it = |message: &Value| {
            let text = message["body"]["output"].as_str().unwrap_or_default();
            message["event"] == "output" && text.contains(part)
        };
        let message = self.take(part, is_it);
        message["body"]["output"]
            .as_str()
            .unwrap_or_default()
            .to_owned()
    }

    /// Introduces itself and launches; breakpoints can be set then.
    pub fn launch(&mut self, arguments: Value) {
        self.request("initialize", json!({"adapterID": "swanilda"}));
        self.request("launch", arguments);
        self.event("initialized");
    }

    /// Sets breakpoints of a file; where they are.
    pub fn set_breakpoints(&mut self, file: &Path, breakpoints: Value) -> Vec<Value> {
        let source = json!({"path": file});
        let set = self.request(
            "setBreakpoints",
            json!({"source": source, "breakpoints": breakpoints}),
        );
        set["breakpoints"].as_array().cloned().unwrap_or_default()
    }

    /// All breakpoints are set: the simulation runs.
    pub fn run(&mut self) {
        self.request("configurationDone", json!({}));
    }

    /// Waits until the code stops for this reason; the place, as `function:line` of each frame.
    pub fn stopped(&mut self, reason: &str) -> Stopped {
        let is_it =
            |message: &Value| message["event"] == "stopped" || message["event"] == "terminated";
        let stopped = self.take("stopped", is_it);
        let thread = stopped["body"]["threadId"].clone();
        assert_eq!(stopped["body"]["reason"], reason, "{stopped}");
        self.at(thread)
    }

    /// Where a script is.
    pub fn at(&mut self, thread: Value) -> Stopped {
        let trace = self.request("stackTrace", json!({"threadId": thread}));
        let frames = trace["stackFrames"].as_array().cloned().unwrap_or_default();
        Stopped { thread, frames }
    }

    /// Lets the code go on in this way.
    pub fn go(&mut self, command: &str, from: &Stopped) {
        self.request(command, json!({"threadId": from.thread}));
    }

    /// The value of an expression in the innermost frame.
    pub fn evaluate(&mut self, at: &Stopped, expression: &str) -> String {
        let frame = &at.frames[0]["id"];
        let result = self.request(
            "evaluate",
            json!({"expression": expression, "frameId": frame}),
        );
        result["result"].as_str().unwrap_or_default().to_owned()
    }

    /// The variables of a scope of the innermost frame.
    pub fn scope(&mut self, at: &Stopped, name: &str) -> (Value, Vec<Value>) {
        let scopes = self.request("scopes", json!({"frameId": at.frames[0]["id"]}));
        let scopes = scopes["scopes"].as_array().cloned().unwrap_or_default();
        let scope = scopes.into_iter().find(|scope| scope["name"] == name);
        let reference = scope.expect("there is such a scope")["variablesReference"].clone();
        (reference.clone(), self.variables(&reference))
    }

    /// The variables with that number.
    pub fn variables(&mut self, reference: &Value) -> Vec<Value> {
        let found = self.request("variables", json!({"variablesReference": reference}));
        found["variables"].as_array().cloned().unwrap_or_default()
    }

    /// Waits for the end of the run, and of the command; its exit code.
    pub fn end(mut self) -> Option<i32> {
        self.event("terminated");
        self.close();
        self.exit_code()
    }

    /// Says nothing more.
    pub fn close(&mut self) {
        self.output = Box::new(std::io::sink());
    }

    /// Waits for the end of the command.
    pub fn exit_code(&mut self) -> Option<i32> {
        for _ in 0..TIMEOUT.as_millis() / 20 {
            let command = self.command.as_mut().expect("it was started");
            if let Some(status) = command.try_wait().expect("it can be waited for") {
                return status.code();
            }
            std::thread::sleep(Duration::from_millis(20));
        }
        panic!("the command does not end");
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        if let Some(command) = &mut self.command {
            let _ = command.kill();
            let _ = command.wait();
        }
    }
}

/// A script that stands still.
pub struct Stopped {
    /// The thread of the script.
    pub thread: Value,
    /// What runs in it, innermost first.
    pub frames: Vec<Value>,
}

impl Stopped {
    /// `function:line` of each frame.
    pub fn calls(&self) -> Vec<String> {
        let frames = self.frames.iter();
        let calls = frames.map(|frame| {
            format!(
                "{}:{}",
                frame["name"].as_str().unwrap_or_default(),
                frame["line"]
            )
        });
        calls.collect()
    }

    /// The line of the innermost frame.
    pub fn line(&self) -> u64 {
        self.frames[0]["line"].as_u64().expect("a line")
    }
}

fn spawn(program: &str, arguments: &[&str]) -> Child {
    Command::new(program)
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("the command starts")
}

fn read(input: &mut impl BufRead) -> Option<Value> {
    let mut length = 0;
    loop {
        let mut line = String::new();
        if input.read_line(&mut line).ok()? == 0 {
            return None;
        }
        match line.trim().strip_prefix("Content-Length: ") {
            Some(text) => length = text.parse().ok()?,
            None if line.trim().is_empty() => break,
            None => {}
        }
    }
    let mut bytes = vec![0; length];
    input.read_exact(&mut bytes).ok()?;
    serde_json::from_slice(&bytes).ok()
}

/// The variable of that name.
pub fn named<'a>(variables: &'a [Value], name: &str) -> &'a Value {
    let found = variables.iter().find(|variable| variable["name"] == name);
    found.unwrap_or_else(|| panic!("there is no {name} in {variables:#?}"))
}
