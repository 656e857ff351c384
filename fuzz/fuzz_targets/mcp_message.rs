//! Any bytes as a message of the Model Context Protocol, before and after a session has begun: an answer in its form, with the id of the request,
//! or none.
//!
//! `cargo fuzz run mcp_message`
#![no_main]

use std::rc::Rc;

use libfuzzer_sys::fuzz_target;
use mcp::{About, Answer, Contents, NotFound, Notify, Progress, Resource, Service, Session, Template, Tool, parse};
use serde_json::{Value, json};

struct Echo(Vec<Tool>);

impl Service for Echo {
    fn about(&self) -> About {
        About { name: "echo", title: "Echo", version: "1", instructions: String::new() }
    }

    fn tools(&self) -> &[Tool] {
        &self.0
    }

    fn call(&mut self, _: &str, arguments: &Value, progress: &Progress) -> Answer {
        progress.report(1.0, None, String::new);
        assert!(arguments.is_object());
        Answer::text(arguments.to_string())
    }

    fn resources(&mut self) -> Vec<Resource> {
        let resource = |number: usize| Resource {
            uri: format!("a://{number}"),
            name: String::new(),
            description: String::new(),
            mime_type: "text/plain",
        };
        (0..250).map(resource).collect()
    }

    fn templates(&self) -> Vec<Template> {
        Vec::new()
    }

    fn read(&mut self, uri: &str) -> Result<Contents, NotFound> {
        Err(NotFound(uri.to_owned()))
    }
}

fn check(answer: &Value, ids: &[Value]) {
    assert_eq!(answer["jsonrpc"], "2.0");
    assert!(answer["result"].is_object() != answer["error"]["code"].is_i64());
    assert!(answer["id"].is_null() || ids.contains(&answer["id"]));
}

fuzz_target!(|bytes: &[u8]| {
    let sent: Value = serde_json::from_slice(bytes).unwrap_or_default();
    let ids: Vec<Value> = match &sent {
        Value::Array(all) => all.iter().map(|one| one["id"].clone()).collect(),
        one => vec![one["id"].clone()],
    };
    let tool = Tool { name: "echo", title: "Echo", description: String::new(), arguments: json!({}), reads_only: true };
    let mut service = Echo(vec![tool]);
    let notify: Notify = Rc::new(|note| assert_eq!(note["method"], "notifications/progress"));
    for version in ["", "2025-03-26", "2025-06-18"] {
        let mut session = Session::default();
        if !version.is_empty() {
            let hello = json!({"jsonrpc": "2.0", "id": 0, "method": "initialize", "params": {"protocolVersion": version}});
            session.answer(&mut service, parse(hello.to_string().as_bytes()), &notify).expect("an answer");
        }
        match session.answer(&mut service, parse(bytes), &notify) {
            Some(Value::Array(all)) => all.iter().for_each(|answer| check(answer, &ids)),
            Some(answer) => check(&answer, &ids),
            None => {}
        }
    }
});
