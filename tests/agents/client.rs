//! A client that speaks to `swanilda mcp` by standard input and output.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use serde_json::{Value, json};

pub struct Client {
    child: Child,
    input: Option<ChildStdin>,
    output: BufReader<ChildStdout>,
    requests: u64,
}

impl Client {
    /// A session that has begun.
    pub fn start(arguments: &[String]) -> Self {
        let mut client = Self::connect(arguments);
        let hello = json!({"protocolVersion": "2025-06-18", "capabilities": {}, "clientInfo": {"name": "tasks", "version": "1"}});
        let answer = client.request("initialize", &hello);
        assert_eq!(
            answer["result"]["protocolVersion"], "2025-06-18",
            "{answer}"
        );
        client.send(&json!({"jsonrpc": "2.0", "method": "notifications/initialized"}));
        client
    }

    /// A process to which nothing was said.
    pub fn connect(arguments: &[String]) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
        command
            .arg("mcp")
            .args(arguments)
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::inherit());
        let mut child = command.spawn().expect("the server starts");
        let input = child.stdin.take();
        let output = BufReader::new(child.stdout.take().expect("standard output is piped"));
        Self {
            child,
            input,
            output,
            requests: 0,
        }
    }

    pub fn send(&mut self, message: &Value) {
        self.send_text(&message.to_string());
    }

    pub fn send_text(&mut self, text: &str) {
        let input = self.input.as_mut().expect("the input is open");
        input
            .write_all(format!("{text}\n").as_bytes())
            .expect("the server reads");
    }

    /// The next line of the server.
    pub fn receive(&mut self) -> Value {
        let mut line = String::new();
        self.output.read_line(&mut line).expect("the server writes");
        serde_json::from_str(&line).unwrap_or_else(|error| panic!("{error}: {line:?}"))
    }

    /// Sends a request; its id.
    pub fn begin(&mut self, method: &str, params: &Value) -> u64 {
        self.requests += 1;
        let id = self.requests;
        self.send(&json!({"jsonrpc": "2.0", "id": id, "method": method, "params": params}));
        id
    }

    pub fn request(&mut self, method: &str, params: &Value) -> Value {
        let id = self.begin(method, params);
        let answer = self.receive();
        assert_eq!(answer["id"], id, "{answer}");
        answer
    }

    /// Calls a tool: its texts in `text`, what is structured in `values`, the number of pictures, and whether it is an error.
    pub fn call(&mut self, tool: &str, arguments: &Value) -> Value {
        let answer = self.request("tools/call", &json!({"name": tool, "arguments": arguments}));
        let result = &answer["result"];
        assert!(result.is_object(), "{answer}");
        let content = result["content"].as_array().expect("content");
        let texts: Vec<&str> = content
            .iter()
            .filter_map(|part| part["text"].as_str())
            .collect();
        let pictures = content
            .iter()
            .filter(|part| part["type"] == "image")
            .count();
        json!({
            "text": texts.join("\n"),
            "values": result["structuredContent"],
            "pictures": pictures,
            "isError": result["isError"],
        })
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        // The server ends with its input.
        self.input = None;
        let _ = self.child.wait();
    }
}
