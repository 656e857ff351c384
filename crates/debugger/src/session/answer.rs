//! Answers to requests.

use std::rc::Rc;

use script::Sim;
use serde_json::{Value, json};

use super::{Ending, Exceptions, Flow, Session, Travel};
use crate::request::{Refusal, Request, event};
use crate::stepping::{Mode, Origin};

/// What was done, and whether the code goes on.
type Answer = Result<(Value, Flow), Refusal>;

/// What this adapter can do.
fn capabilities(goes_back: bool) -> Value {
    json!({
        "supportsConfigurationDoneRequest": true,
        "supportsCancelRequest": true,
        "supportsFunctionBreakpoints": true,
        "supportsConditionalBreakpoints": true,
        "supportsHitConditionalBreakpoints": true,
        "supportsLogPoints": true,
        "supportsEvaluateForHovers": true,
        "supportsSetVariable": true,
        "supportsSetExpression": true,
        "supportsRestartRequest": true,
        "supportsTerminateRequest": true,
        "supportsLoadedSourcesRequest": true,
        "supportsExceptionInfoRequest": true,
        "supportsDelayedStackTraceLoading": true,
        "supportsBreakpointLocationsRequest": true,
        "supportsVariablePaging": true,
        "supportsDataBreakpoints": true,
        "supportTerminateDebuggee": true,
        "supportsStepBack": goes_back,
        "exceptionBreakpointFilters": [
            {"filter": "uncaught", "label": "Uncaught errors", "default": true},
            {"filter": "caught", "label": "Caught errors", "default": false},
        ],
    })
}

impl Session {
    /// Answers a request; whether the code goes on.
    pub(super) fn answer(&self, sim: Option<&Rc<Sim>>, request: &Request) -> Flow {
        let (answer, flow) = match self.perform(sim, request) {
            Ok((body, flow)) => (request.answer(Ok(body)), flow),
            Err(reason) => (request.answer(Err(reason)), Flow::Stay),
        };
        self.send(answer);
        match request.command.as_str() {
            // Breakpoints come next, which have to wait until it is known what is debugged.
            "launch" | "attach" => self.send(event("initialized", Value::Null)),
            "disconnect" if flow == Flow::GoOn => return self.lose_client(sim),
            _ => {}
        }
        flow
    }

    fn perform(&self, sim: Option<&Rc<Sim>>, request: &Request) -> Answer {
        if let Some(answer) = self.perform_without_run(sim, request) {
            return answer.map(|body| (body, Flow::Stay));
        }
        let sim = sim.ok_or_else(|| format!("{}: nothing runs yet", request.command))?;
        let body = match request.command.as_str() {
            "threads" => Ok(self.threads(sim)),
            "stackTrace" => self.stack_trace(sim, request),
            "scopes" => self.scopes(request),
            "variables" => self.variables(sim, request),
            "evaluate" => self.evaluate(sim, request),
            "setVariable" => self.set_variable(sim, request),
            "setExpression" => self.set_expression(sim, request),
            "exceptionInfo" => self.exception_info(),
            "dataBreakpointInfo" => self.data_breakpoint_info(sim, request),
            _ => return self.perform_control(sim, request),
        };
        body.map(|body| (body, Flow::Stay))
    }

    /// What can be done at any time; None for other requests.
    fn perform_without_run(
        &self,
        sim: Option<&Rc<Sim>>,
        request: &Request,
    ) -> Option<Result<Value, Refusal>> {
        Some(match request.command.as_str() {
            "initialize" => Ok(capabilities(self.is_replay.get())),
            "launch" | "attach" => self.note_launch(request),
            // What it is about has ended already.
            "cancel" => Ok(Value::Null),
            "configurationDone" => {
                self.launch.borrow_mut().is_configured = true;
                Ok(Value::Null)
            }
            "setBreakpoints" => self.set_breakpoints(sim, request),
            "setFunctionBreakpoints" => {
                let texts = self.texts.borrow();
                let texts = texts.iter().map(Rc::as_ref);
                let list = request.list("breakpoints");
                let set = self.breakpoints.borrow_mut().set_functions(list, texts);
                self.arm_all(sim);
                Ok(json!({"breakpoints": set}))
            }
            "setExceptionBreakpoints" => {
                let filters = request.list("filters");
                self.exceptions.set(Exceptions {
                    caught: filters.contains(&json!("caught")),
                    uncaught: filters.contains(&json!("uncaught")),
                });
                Ok(Value::Null)
            }
            "setDataBreakpoints" => {
                let list = request.list("breakpoints");
                let set = self.data.borrow_mut().set(sim, list);
                Ok(json!({"breakpoints": set}))
            }
            "breakpointLocations" => self.breakpoint_locations(request),
            "loadedSources" => Ok(json!({"sources": self.sources.borrow().all()})),
            "source" => self.source(request),
            _ => return None,
        })
    }

    fn set_breakpoints(&self, sim: Option<&Rc<Sim>>, request: &Request) -> Result<Value, Refusal> {
        let key = self.sources.borrow().key(request.get("source"))?;
        let list = request.list("breakpoints");
        let sources = self.sources.borrow();
        let set = self.breakpoints.borrow_mut().set_lines(key, list, &sources);
        drop(sources);
        self.arm_all(sim);
        Ok(json!({"breakpoints": set}))
    }

    fn breakpoint_locations(&self, request: &Request) -> Result<Value, Refusal> {
        let sources = self.sources.borrow();
        let key = sources.key(request.get("source"))?;
        let line = |name| u32::try_from(request.get(name).as_u64().unwrap_or_default());
        let first = line("line").unwrap_or(u32::MAX);
        let last = line("endLine").unwrap_or(u32::MAX).max(first);
        let lines = sources.lines(&key).unwrap_or_default();
        let there: Vec<Value> = lines
            .range(first..=last)
            .map(|line| json!({"line": line}))
            .collect();
        Ok(json!({"breakpoints": there}))
    }

    fn source(&self, request: &Request) -> Result<Value, Refusal> {
        let sources = self.sources.borrow();
        let by_path = request.get("source")["path"].is_string();
        if by_path && let Some(text) = sources.text(&sources.key(request.get("source"))?) {
            return Ok(json!({"content": text, "mimeType": "text/x-lua"}));
        }
        let reference = match request.get("source")["sourceReference"].as_i64() {
            Some(reference) => reference,
            None => request.number("sourceReference")?,
        };
        let text = sources.content(reference);
        let text = text.ok_or_else(|| format!("there is no text with the number {reference}"))?;
        Ok(json!({"content": text, "mimeType": "text/x-lua"}))
    }

    fn exception_info(&self) -> Result<Value, Refusal> {
        let stop = self.stop.borrow();
        let error = stop.as_ref().and_then(|stop| stop.error.clone());
        let (message, is_caught) = error.ok_or("no error has stopped the code")?;
        Ok(json!({
            "exceptionId": "error", "description": message,
            "breakMode": if is_caught { "always" } else { "unhandled" },
        }))
    }

    /// What lets the code go on, or ends it.
    fn perform_control(&self, sim: &Rc<Sim>, request: &Request) -> Answer {
        let gone_on = |body: Value| Ok((body, Flow::GoOn));
        match request.command.as_str() {
            "continue" => {
                self.set_mode(Some(sim), Mode::Run);
                gone_on(json!({"allThreadsContinued": true}))
            }
            "next" => self.step(sim, Mode::Over),
            "stepOut" => self.step(sim, Mode::Out),
            "stepIn" => self.step(sim, |_| Mode::Into),
            "stepBack" => self.go_back(Travel::StepBack),
            "reverseContinue" => self.go_back(Travel::ReverseContinue),
            "pause" => {
                self.pause.set(true);
                self.pause_is_late.set(false);
                self.arm_all(Some(sim));
                Ok((Value::Null, Flow::Stay))
            }
            "terminate" if self.is_attached => {
                sim.copied_out(|sim| sim.stop());
                self.set_mode(Some(sim), Mode::Run);
                gone_on(Value::Null)
            }
            "restart" if self.is_attached => {
                Err("only what the debugger has launched can be restarted".into())
            }
            "terminate" => {
                self.end(Some(sim), Ending::Terminate);
                gone_on(Value::Null)
            }
            "restart" => {
                self.note_restart(request);
                self.end(Some(sim), Ending::Restart);
                gone_on(Value::Null)
            }
            "disconnect" => gone_on(Value::Null),
            other => Err(format!("{other} is not supported")),
        }
    }

    /// Goes to an earlier moment, which only a capture has.
    fn go_back(&self, travel: Travel) -> Answer {
        if !self.is_replay.get() {
            let reason = "only a capture goes back: swanilda run SCENE --capture FILE.swc, then debug FILE.swc";
            return Err(reason.into());
        }
        if !self.can_travel.get() {
            return Err("the scene of the capture is being loaded: there is nothing before".into());
        }
        self.travel.set(Some(travel));
        Ok((Value::Null, Flow::GoOn))
    }

    /// Begins a step where the code stands still; elsewhere the next line of any script ends it.
    fn step(&self, sim: &Rc<Sim>, mode: impl FnOnce(Origin) -> Mode) -> Answer {
        let stop = self.stop.borrow().clone().ok_or("the code runs")?;
        self.set_mode(Some(sim), stop.origin.map_or(Mode::Into, mode));
        Ok((Value::Null, Flow::GoOn))
    }
}
