//! A service of one tool, or of none, for tests of the ways to reach it.

use mcp::{About, Answer, Contents, NotFound, Progress, Resource, Service, Template, Tool};
use serde_json::{Value, json};

/// Has no resources. Its tools do what the function does.
pub struct Serving<F> {
    tools: Vec<Tool>,
    call: F,
}

impl<F: FnMut(&Progress) -> Answer> Serving<F> {
    pub fn new(name: &'static str, call: F) -> Self {
        let tool = Tool {
            name,
            title: "A tool",
            description: String::new(),
            arguments: json!({"type": "object"}),
            reads_only: true,
        };
        let tools = vec![tool];
        Self { tools, call }
    }
}

impl<F: FnMut(&Progress) -> Answer> Service for Serving<F> {
    fn about(&self) -> About {
        About {
            name: "test",
            title: "Test",
            version: "1",
            instructions: String::new(),
        }
    }

    fn tools(&self) -> &[Tool] {
        &self.tools
    }

    fn call(&mut self, _: &str, _: &Value, progress: &Progress) -> Answer {
        (self.call)(progress)
    }

    fn resources(&mut self) -> Vec<Resource> {
        Vec::new()
    }

    fn templates(&self) -> Vec<Template> {
        Vec::new()
    }

    fn read(&mut self, uri: &str) -> Result<Contents, NotFound> {
        Err(NotFound(uri.into()))
    }
}

/// What a tool does that says twice how far it is, however often it could.
pub fn say_twice(progress: &Progress) -> Answer {
    let (mut said, mut done) = (0, 0.0);
    while said < 2 {
        done += 1.0;
        progress.report(done, Some(1e12), || {
            said += 1;
            format!("note {said}")
        });
    }
    Answer::text("done")
}

/// A call of the tool that is to say how far it is.
pub fn call_with_progress(id: u64, tool: &str) -> Value {
    let params = json!({"name": tool, "_meta": {"progressToken": "mine"}});
    json!({"jsonrpc": "2.0", "id": id, "method": "tools/call", "params": params})
}

/// Checks two notes and the answer to a call with that id.
pub fn check_progress(messages: &[Value], id: u64) {
    let [first, second, answer] = messages else {
        panic!("two notes and an answer: {messages:?}");
    };
    for (note, text) in [(first, "note 1"), (second, "note 2")] {
        assert_eq!(note["method"], "notifications/progress");
        let params = &note["params"];
        assert_eq!(
            (
                &params["progressToken"],
                &params["total"],
                &params["message"]
            ),
            (&json!("mine"), &json!(1e12), &json!(text))
        );
    }
    let done = |note: &Value| note["params"]["progress"].as_f64();
    assert!(done(first) < done(second), "{messages:?}");
    assert_eq!(answer["id"], id);
    assert_eq!(answer["result"]["content"][0]["text"], "done");
}
