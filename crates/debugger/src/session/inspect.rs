//! What stands still: threads, frames, variables, expressions.

use std::rc::Rc;

use script::{Container, Debuggee, Page, PageKind, Sim, Variable};
use serde_json::{Value, json};

use super::Session;
use crate::data;
use crate::objects;
use crate::references::{FrameOf, Node};
use crate::request::{Refusal, Request};

/// Frames that are shown at once.
const MAX_FRAMES: usize = 1000;

impl Session {
    /// Each script that runs is a thread.
    pub(super) fn threads(&self, sim: &Rc<Sim>) -> Value {
        let running = sim.copied_out(|sim| {
            let scripts = sim.named_scripts().into_iter();
            let running = scripts.filter(|(script, _)| {
                let runtime = script.current_runtime();
                runtime.is_some_and(|runtime| runtime.interpreter.debuggee().is_some())
            });
            let running = running.map(|(script, name)| (script.id, name));
            running.collect::<Vec<_>>()
        });
        let mut threads: Vec<Value> = running
            .into_iter()
            .map(|(id, name)| json!({"id": id, "name": name}))
            .collect();
        if threads.is_empty() {
            threads.push(json!({"id": self.default_thread(sim), "name": "simulation"}));
        }
        json!({"threads": threads})
    }

    /// The script that is shown where none runs.
    pub(super) fn default_thread(&self, sim: &Rc<Sim>) -> i64 {
        sim.copied_out(|sim| {
            let scripts = sim.named_scripts();
            let running = scripts
                .iter()
                .find(|(script, _)| script.current_runtime().is_some());
            running.map_or(1, |(script, _)| script.id)
        })
    }

    pub(super) fn stack_trace(&self, sim: &Rc<Sim>, request: &Request) -> Result<Value, Refusal> {
        let script = request.number("threadId")?;
        let (start, count) = (request.count("startFrame"), request.count("levels"));
        let all = asked(sim, script, |debuggee| Ok(debuggee.frames(MAX_FRAMES)))?;
        let count = if count == 0 { MAX_FRAMES } else { count };
        let mut shown = Vec::new();
        for frame in all.iter().skip(start).take(count) {
            let id = self.references.borrow_mut().frame(FrameOf {
                script,
                frame: frame.id,
            });
            let mut described =
                json!({"id": id, "name": frame.name, "line": frame.line, "column": 1});
            match &frame.text {
                Some(text) => described["source"] = self.sources.borrow().describe(text),
                None => described["presentationHint"] = json!("subtle"),
            }
            if let Some(script) = frame.text.as_ref().and_then(|text| text.script) {
                described["script"] = json!(script);
            }
            shown.push(described);
        }
        Ok(json!({"stackFrames": shown, "totalFrames": all.len()}))
    }

    pub(super) fn scopes(&self, request: &Request) -> Result<Value, Refusal> {
        let FrameOf { script, frame } = self
            .references
            .borrow()
            .find_frame(request.number("frameId")?)?;
        let of_script = |container| Node::OfScript {
            script,
            container,
            frame: Some(frame),
        };
        let scopes = [
            ("Locals", of_script(Container::Locals(frame)), false),
            ("Upvalues", of_script(Container::Upvalues(frame)), false),
            ("Globals", of_script(Container::Globals), true),
            ("Objects", Node::Objects, true),
        ];
        let scopes = scopes.map(|(name, node, is_expensive)| {
            let reference = self.references.borrow_mut().node(node);
            let mut scope =
                json!({"name": name, "variablesReference": reference, "expensive": is_expensive});
            if name == "Locals" {
                scope["presentationHint"] = json!("locals");
            }
            scope
        });
        Ok(json!({"scopes": scopes}))
    }

    pub(super) fn variables(&self, sim: &Rc<Sim>, request: &Request) -> Result<Value, Refusal> {
        let node = self
            .references
            .borrow()
            .find_node(request.number("variablesReference")?)?;
        let page = Page {
            kind: match request.get("filter").as_str() {
                Some("indexed") => Some(PageKind::Indexed),
                Some("named") => Some(PageKind::Named),
                _ => None,
            },
            start: request.count("start"),
            count: request.count("count"),
        };
        let variables: Vec<Value> = match node {
            Node::OfScript {
                script,
                container,
                frame,
            } => {
                let found = asked(sim, script, |debuggee| {
                    Ok(debuggee.variables(container, page))
                })?;
                let described = found
                    .into_iter()
                    .map(|variable| self.describe(script, frame, variable));
                described.collect()
            }
            Node::Objects => self.objects(sim, None),
            Node::Object(handle) => self.objects(sim, Some(handle)),
        };
        Ok(json!({"variables": variables}))
    }

    /// The properties and children of an object, or the objects without a parent.
    fn objects(&self, sim: &Rc<Sim>, handle: Option<i64>) -> Vec<Value> {
        let entries = objects::entries(sim, handle).into_iter();
        let described = entries.map(|entry| {
            let reference = entry.object.map_or(0, |object| {
                self.references.borrow_mut().node(Node::Object(object))
            });
            let mut described = json!({
                "name": entry.name, "value": entry.value, "type": entry.kind, "variablesReference": reference,
            });
            if let Some(expression) = entry.expression {
                described["evaluateName"] = json!(expression);
            }
            if entry.is_read_only {
                described["presentationHint"] = json!({"attributes": ["readOnly"]});
            }
            described
        });
        described.collect()
    }

    /// A variable, as clients see it.
    fn describe(&self, script: i64, frame: Option<script::FrameId>, variable: Variable) -> Value {
        let reference = variable.contents.map_or(0, |contents| {
            self.references.borrow_mut().node(Node::OfScript {
                script,
                container: Container::Value(contents),
                frame,
            })
        });
        json!({
            "name": variable.name, "value": variable.value, "type": variable.kind, "variablesReference": reference,
            "indexedVariables": variable.indexed, "namedVariables": variable.named,
        })
    }

    /// The same as the result of an expression.
    fn describe_result(
        &self,
        script: i64,
        frame: Option<script::FrameId>,
        value: Variable,
    ) -> Value {
        let mut described = self.describe(script, frame, value);
        described["result"] = described["value"].clone();
        described
    }

    /// The script and function in which expressions are evaluated: those of a frame, or the script that stands still, or the sandbox.
    fn place_of(
        &self,
        sim: &Rc<Sim>,
        request: &Request,
    ) -> Result<(i64, Option<script::FrameId>), Refusal> {
        if let Some(number) = request.get("frameId").as_i64() {
            let FrameOf { script, frame } = self.references.borrow().find_frame(number)?;
            return Ok((script, Some(frame)));
        }
        let stopped = self.stop.borrow().as_ref().and_then(|stop| stop.script);
        Ok((stopped.unwrap_or_else(|| objects::sandbox(sim)), None))
    }

    /// Whether a variable, or what `name` alone names, is a property that can be watched.
    pub(super) fn data_breakpoint_info(
        &self,
        sim: &Rc<Sim>,
        request: &Request,
    ) -> Result<Value, Refusal> {
        let name = request.text("name")?;
        let property = match request.get("variablesReference").as_i64() {
            Some(reference) if reference > 0 => {
                match self.references.borrow().find_node(reference)? {
                    Node::Object(handle) => data::name(sim, handle, name),
                    _ => None,
                }
            }
            _ => Some(name.to_owned()),
        };
        Ok(
            match property.filter(|property| data::exists(sim, property)) {
                Some(property) => json!({
                    "dataId": property, "description": property, "accessTypes": ["write"], "canPersist": true,
                }),
                None => json!({
                    "dataId": null, "description": "only properties of objects can be watched, such as /Box.pose",
                }),
            },
        )
    }

    pub(super) fn evaluate(&self, sim: &Rc<Sim>, request: &Request) -> Result<Value, Refusal> {
        let (script, frame) = self.place_of(sim, request)?;
        let expression = request.text("expression")?;
        let value = asked(sim, script, |debuggee| debuggee.evaluate(frame, expression))?;
        Ok(self.describe_result(script, frame, value))
    }

    pub(super) fn set_variable(&self, sim: &Rc<Sim>, request: &Request) -> Result<Value, Refusal> {
        let node = self
            .references
            .borrow()
            .find_node(request.number("variablesReference")?)?;
        let (name, value) = (request.text("name")?, request.text("value")?);
        match node {
            Node::OfScript {
                script,
                container,
                frame,
            } => {
                let new = asked(sim, script, |debuggee| {
                    debuggee.assign(container, name, frame, value)
                })?;
                Ok(self.describe(script, frame, new))
            }
            Node::Objects => Err("objects cannot be replaced".into()),
            Node::Object(handle) => {
                let (script, _) = self.place_of(sim, request)?;
                let data = asked(sim, script, |debuggee| debuggee.evaluate_data(None, value))?;
                let new = objects::set_property(sim, handle, name, &data)?;
                Ok(json!({"value": new, "variablesReference": 0}))
            }
        }
    }

    /// Assigns a value to an expression such as `x` or `t.x`.
    pub(super) fn set_expression(
        &self,
        sim: &Rc<Sim>,
        request: &Request,
    ) -> Result<Value, Refusal> {
        let (script, frame) = self.place_of(sim, request)?;
        let (expression, value) = (request.text("expression")?, request.text("value")?);
        let new = asked(sim, script, |debuggee| {
            debuggee.evaluate(frame, &format!("{expression} = {value}"))?;
            debuggee.evaluate(frame, expression)
        })?;
        Ok(self.describe(script, frame, new))
    }
}

/// What a script that can be debugged answers.
pub(crate) fn asked<T: Clone>(
    sim: &Rc<Sim>,
    script: i64,
    ask: impl FnOnce(&dyn Debuggee) -> Result<T, Refusal>,
) -> Result<T, Refusal> {
    sim.copied_out(|sim| {
        let script = sim.script(script);
        let runtime = script.and_then(|script| script.current_runtime());
        let runtime = runtime.ok_or("this script does not run")?;
        let debuggee = runtime
            .interpreter
            .debuggee()
            .ok_or("scripts of this language have a debugger of their own")?;
        ask(debuggee)
    })
}
