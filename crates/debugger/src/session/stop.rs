//! Stopping: whether code stops at a place, and answering requests until it goes on.

use std::rc::Rc;
use std::time::Instant;

use script::{Place, Script, Sim, wall_clock};
use serde_json::{Value, json};

use super::{Flow, Session, inspect};
use crate::breakpoints::Rule;
use crate::request::event;
use crate::stepping::{Mode, Origin};

/// Functions among which the one is looked for that people know.
const FRAMES: usize = 50;

/// What everything stands still for.
#[derive(Debug, Clone)]
pub(super) struct Stop {
    /// The script whose code stands still; None between two iterations.
    pub script: Option<i64>,
    /// Where a step would begin.
    pub origin: Option<Origin>,
    /// The error, where one stopped the code.
    pub error: Option<(String, bool)>,
}

/// Why code stops, as clients see it.
pub(super) struct Reason {
    /// The word of the protocol.
    pub word: &'static str,
    /// A sentence.
    pub description: Option<String>,
    /// The breakpoints.
    pub breakpoints: Vec<u64>,
}

impl Reason {
    pub(super) fn new(word: &'static str) -> Self {
        Self {
            word,
            description: None,
            breakpoints: Vec::new(),
        }
    }
}

impl Session {
    /// Stops at a line if a breakpoint or a step wants it.
    pub(super) fn consider_line(&self, sim: &Rc<Sim>, place: &Place<'_>) {
        self.note_line(place);
        let at = self.breakpoints.borrow().at(place.text, place.line);
        let hit: Vec<_> = at
            .into_iter()
            .filter(|(id, _)| self.is_hit(sim, place, *id))
            .collect();
        let reason = if let Some((_, of_function)) = hit.first() {
            Reason {
                breakpoints: hit.iter().map(|(id, _)| *id).collect(),
                ..Reason::new(if *of_function {
                    "function breakpoint"
                } else {
                    "breakpoint"
                })
            }
        } else if self.pause.get() {
            Reason::new("pause")
        } else if self.mode_now().ends_at(place, self.origin_now(sim)) {
            Reason::new("step")
        } else {
            return;
        };
        let stop = Stop {
            script: Some(place.script.id),
            origin: Some(origin(place)),
            error: None,
        };
        self.stopped_at_position(sim, stop, &reason);
    }

    /// The coroutine in which a step began, as it is now.
    fn origin_now(&self, sim: &Rc<Sim>) -> Option<script::CodeLevel> {
        let origin = self.mode.get().origin()?;
        let remembered = inspect::asked(sim, origin.script, |debuggee| Ok(debuggee.remembered()));
        let now = remembered.ok()??;
        (now.coroutine == origin.level.coroutine).then_some(now)
    }

    /// Whether a breakpoint stops the code: its condition is true, for the right time, and it prints nothing instead.
    fn is_hit(&self, sim: &Rc<Sim>, place: &Place<'_>, id: u64) -> bool {
        let rule = self
            .breakpoints
            .borrow_mut()
            .get_mut(id)
            .map(|found| found.rule.clone());
        let Some(rule) = rule else { return false };
        if !self.condition_holds(sim, place, &rule) {
            return false;
        }
        if !self.goal.borrow().is_live() {
            // On the way to another moment, nothing is counted nor printed.
            return rule.log.is_none();
        }
        let hits = self.breakpoints.borrow_mut().get_mut(id).map(|found| {
            found.hits += 1;
            found.hits
        });
        if !rule
            .count
            .is_none_or(|count| hits.is_some_and(|hits| count.holds(hits)))
        {
            return false;
        }
        if let Some(text) = &rule.log {
            self.log(sim, place, text);
        }
        rule.log.is_none()
    }

    /// A condition that fails stops the code too, and says why.
    fn condition_holds(&self, sim: &Rc<Sim>, place: &Place<'_>, rule: &Rule) -> bool {
        let Some(condition) = &rule.condition else {
            return true;
        };
        match self.evaluate_at(sim, place, condition) {
            Ok(value) => value != "nil" && value != "false",
            Err(reason) => {
                self.print(
                    "stderr",
                    &format!("the condition of a breakpoint fails: {reason}\n"),
                );
                true
            }
        }
    }

    /// The value of an expression in the function that is at a place.
    fn evaluate_at(
        &self,
        sim: &Rc<Sim>,
        place: &Place<'_>,
        expression: &str,
    ) -> Result<String, String> {
        let evaluate = || {
            inspect::asked(sim, place.script.id, |debuggee| {
                let frame = debuggee.frames(1).first().map(|frame| frame.id);
                Ok(debuggee.evaluate(frame, expression)?.value)
            })
        };
        if self.is_replay.get() {
            sim.without_trace(evaluate)
        } else {
            evaluate()
        }
    }

    /// Prints the text of a log point, with the values of what is in braces.
    fn log(&self, sim: &Rc<Sim>, place: &Place<'_>, text: &str) {
        let (mut shown, mut rest) = (String::new(), text);
        while let Some((before, after)) = rest.split_once('{')
            && let Some((expression, after)) = after.split_once('}')
        {
            shown.push_str(before);
            match self.evaluate_at(sim, place, expression) {
                Ok(value) => shown.push_str(&value),
                Err(reason) => shown.push_str(&format!("<{reason}>")),
            }
            rest = after;
        }
        let source = self.sources.borrow().describe(place.text);
        self.send(event(
            "output",
            json!({"category": "console", "output": format!("{shown}{rest}\n"), "source": source, "line": place.line}),
        ));
    }

    /// Stops if a watched property has changed: by the call that the script has just made, or without one.
    pub(super) fn consider_changes(&self, sim: &Rc<Sim>, script: Option<&Rc<Script>>) {
        let counts = self.goal.borrow().is_live();
        let changes = self.data.borrow_mut().changes(sim, counts);
        if changes.is_empty() || !self.listens(sim) {
            return;
        }
        let by = match script {
            Some(_) => "",
            None => ", by the simulation",
        };
        let texts: Vec<String> = changes
            .iter()
            .map(|change| format!("{}{by}", change.text))
            .collect();
        let reason = Reason {
            description: Some(texts.join("\n")),
            breakpoints: changes.iter().map(|change| change.id).collect(),
            ..Reason::new("data breakpoint")
        };
        let stop = Stop {
            script: script.map(|script| script.id),
            origin: None,
            error: None,
        };
        self.stopped_at_position(sim, stop, &reason);
    }

    /// Stops where an error was raised.
    pub(super) fn stop_at_error(
        &self,
        sim: &Rc<Sim>,
        script: &Rc<Script>,
        message: &str,
        is_caught: bool,
    ) {
        let reason = Reason {
            description: Some(message.to_owned()),
            ..Reason::new("exception")
        };
        let stop = Stop {
            script: Some(script.id),
            origin: None,
            error: Some((message.to_owned(), is_caught)),
        };
        self.stopped_at_position(sim, stop, &reason);
    }

    /// Stops since the client asked for it: in the code that runs, or between two iterations.
    pub(super) fn stop_for_pause(&self, sim: &Rc<Sim>, script: Option<&Rc<Script>>) {
        let stop = Stop {
            script: script.map(|script| script.id),
            origin: None,
            error: None,
        };
        self.stopped_at_position(sim, stop, &Reason::new("pause"));
    }

    /// The code has come to the present [`position`](Self::position) and stands still: answers requests until the client lets it go on. The
    /// time that passes does not count for the simulation.
    pub(super) fn stopped_at_position(&self, sim: &Rc<Sim>, stop: Stop, reason: &Reason) {
        if self.stop.borrow().is_some() || !self.has_client.get() {
            return;
        }
        if !self.goal.borrow().is_live() && !self.reaches() {
            return;
        }
        let begun: Instant = wall_clock::now();
        self.pause.set(false);
        self.last_stop.set((self.position.get(), stop.origin));
        self.mode.set(Mode::Run);
        let thread = stop.script.unwrap_or_else(|| self.default_thread(sim));
        self.stop.replace(Some(stop));
        self.send(stopped_event(thread, reason));
        self.client
            .note_stop(Some(&self.describe_stop(sim, reason)));
        if self.is_replay.get() {
            // What the client inspects and changes is no part of the run.
            sim.without_trace(|| self.answer_until_it_goes_on(sim));
        } else {
            self.answer_until_it_goes_on(sim);
            self.forget_values(sim);
            sim.clock.leave_out(begun.elapsed().as_secs_f64());
        }
        self.client.note_stop(None);
        self.stop.replace(None);
        self.references.borrow_mut().clear();
        self.remember(sim);
        self.arm_all(Some(sim));
        if self.travel.get().is_some() {
            self.pass();
            sim.abandon();
        }
    }

    /// Where everything stands still, for whoever is no debugger: the innermost text.
    fn describe_stop(&self, sim: &Rc<Sim>, reason: &Reason) -> Value {
        let script = self.stop.borrow().as_ref().and_then(|stop| stop.script);
        let innermost = script.and_then(|script| {
            let frames = inspect::asked(sim, script, |debuggee| Ok(debuggee.frames(FRAMES)));
            let with_text = |frame: script::Frame| Some((frame.text?, frame.line));
            frames.ok()?.into_iter().find_map(with_text)
        });
        let text = innermost.as_ref().map(|(text, _)| text);
        json!({
            "handle": text.and_then(|text| text.script).or(script),
            "title": text.map(|text| &text.title),
            "isOwn": text.is_some_and(|text| text.script.is_some()),
            "line": innermost.as_ref().map(|(_, line)| line),
            "reason": reason.word,
            "text": reason.description,
        })
    }

    fn answer_until_it_goes_on(&self, sim: &Rc<Sim>) {
        while !sim.options.is_interrupted() {
            let Some(incoming) = self.next_incoming(sim) else {
                continue;
            };
            if self.receive(Some(sim), incoming) == Flow::GoOn {
                break;
            }
        }
    }

    fn forget_values(&self, sim: &Rc<Sim>) {
        sim.copied_out(|sim| {
            for (script, _) in sim.named_scripts() {
                let runtime = script.current_runtime();
                if let Some(debuggee) = runtime
                    .as_ref()
                    .and_then(|runtime| runtime.interpreter.debuggee())
                {
                    debuggee.forget_values();
                }
            }
        });
    }
}

pub(super) fn origin(place: &Place<'_>) -> Origin {
    Origin {
        script: place.script.id,
        level: place.level(),
        function: place.function,
    }
}

fn stopped_event(thread: i64, reason: &Reason) -> Value {
    let mut body = json!({
        "reason": reason.word, "threadId": thread, "allThreadsStopped": true, "hitBreakpointIds": reason.breakpoints,
    });
    if let Some(description) = &reason.description {
        body["text"] = json!(description);
        body["description"] = json!(description);
    }
    event("stopped", body)
}
