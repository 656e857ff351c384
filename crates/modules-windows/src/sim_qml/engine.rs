//! An engine with an interface: its process, its windows, and the events for its script.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, VecDeque};
use std::rc::Rc;

use scene::Data;
use script::log::verbosity;
use script::{ScriptCallback, wall_clock};
use ui::{CanvasInput, Pointer, Ui};

use super::message::{Level, Message, request};
use super::process::{LIMIT, Process};
use crate::Cx;

/// Events that wait for their script while it waits for an answer; further ones are lost.
const MAX_WAITING: usize = 100_000;
/// Messages that are read at once: the rest comes in the next iteration.
const AT_ONCE: usize = 1000;

/// What comes of a process, as it is on the tape: a message, or why there will be none any more.
pub(super) type Arrival = Result<Vec<u8>, String>;

/// An engine that has loaded an interface.
pub(super) struct Engine {
    /// What scripts call it.
    pub(super) handle: String,
    script: i64,
    handler: ScriptCallback,
    ui: Rc<RefCell<Ui>>,
    /// None in a replay, and once it has ended.
    process: RefCell<Option<Process>>,
    /// The windows of scripts that show its windows, by the numbers of those.
    windows: RefCell<BTreeMap<i64, String>>,
    /// Why nothing is sent to the process any more.
    failure: RefCell<Option<String>>,
    events: RefCell<VecDeque<(String, Vec<u8>)>>,
    questions: Cell<i64>,
}

impl Engine {
    pub(super) fn new(
        cx: &Cx,
        handle: String,
        handler: ScriptCallback,
        process: Option<Process>,
    ) -> Self {
        Self {
            handle,
            script: cx.script().id,
            handler,
            ui: cx.windows(),
            process: RefCell::new(process),
            windows: RefCell::default(),
            failure: RefCell::default(),
            events: RefCell::default(),
            questions: Cell::new(0),
        }
    }

    /// Whether it shows this window, and by which number.
    pub(super) fn window(&self, handle: &str) -> Option<i64> {
        let windows = self.windows.borrow();
        let found = windows.iter().find(|(_, window)| *window == handle);
        found.map(|(number, _)| *number)
    }

    /// Sends the process a message. That it has ended is said when its messages are read, and nothing is sent after that.
    pub(super) fn send(&self, kind: &str, fields: &[Data]) {
        if self.failure.borrow().is_some() {
            return;
        }
        if let Some(process) = &mut *self.process.borrow_mut()
            && let Err(reason) = process.send(&request(kind, fields))
        {
            self.failure.replace(Some(reason));
        }
    }

    /// Asks the process for something.
    ///
    /// # Errors
    /// Why it is refused, and when the process has ended or does not answer.
    pub(super) fn ask(&self, cx: &Cx, kind: &str, fields: &[Data]) -> Result<Data, String> {
        let number = self.questions.get() + 1;
        self.questions.set(number);
        self.send(kind, &[&[Data::Int(number)], fields].concat());
        self.wait(cx, |message| match message {
            Message::Answer(of, value) if of == number => Ok(Ok(value)),
            Message::Refused(of, why) if of == number => Ok(Err(why)),
            other => Err(other),
        })?
    }

    /// Waits for the message that `pick` wants, and does what the others say.
    ///
    /// # Errors
    /// When the process has ended or does not answer, and when the program is to end.
    pub(super) fn wait<T>(
        &self,
        cx: &Cx,
        mut pick: impl FnMut(Message) -> Result<T, Message>,
    ) -> Result<T, String> {
        let begun = wall_clock::now();
        loop {
            let arrival = cx.permissions().tape().input("a message of QML", || {
                let mut process = self.process.borrow_mut();
                let process = process.as_mut().ok_or("The interface has ended.")?;
                if let Some(reason) = self.failure.take() {
                    return Err(reason);
                }
                if begun.elapsed() > LIMIT {
                    return Err("The interface goes on without an answer.".into());
                }
                process.wait(cx)
            });
            let arrival = arrival.unwrap_or_else(|lost| Err(lost.to_string()));
            let message = arrival.and_then(|bytes| self.read(&bytes));
            let message = message.inspect_err(|_| self.close())?;
            match pick(message) {
                Ok(wanted) => return Ok(wanted),
                Err(other) => self.apply(other),
            }
        }
    }

    fn read(&self, bytes: &[u8]) -> Result<Message, String> {
        let message = Message::decode(bytes);
        message.map_err(|error| format!("The interface sent what cannot be read: {error}."))
    }

    /// What has arrived, up to a number of messages.
    pub(super) fn arrivals(&self) -> Vec<Arrival> {
        let mut process = self.process.borrow_mut();
        let Some(process) = process.as_mut() else {
            return Vec::new();
        };
        let failed = self.failure.take().map(Err);
        let next = || process.next().transpose();
        let mut arrived = Vec::new();
        for arrival in failed
            .into_iter()
            .chain(std::iter::from_fn(next))
            .take(AT_ONCE)
        {
            let is_last = arrival.is_err();
            arrived.push(arrival);
            if is_last {
                break;
            }
        }
        arrived
    }

    /// Does what has arrived says.
    pub(super) fn handle(&self, arrival: Arrival) {
        match arrival.and_then(|bytes| self.read(&bytes)) {
            Ok(message) => self.apply(message),
            Err(reason) => {
                self.close();
                self.log(verbosity::SCRIPT_ERRORS, &reason);
            }
        }
    }

    fn apply(&self, message: Message) {
        match message {
            Message::Window {
                number,
                title,
                visible,
                size,
                resizable,
            } => self.arrange(number, &title, visible, size, resizable),
            Message::Gone(number) => {
                if let Some(window) = self.windows.borrow_mut().remove(&number) {
                    // The script may have destroyed it.
                    let _ = self.ui.borrow_mut().destroy(&window);
                }
            }
            Message::Picture { number, size, png } => {
                if let Some(window) = self.windows.borrow().get(&number) {
                    let draw =
                        |canvas: &mut ui::Canvas| (canvas.size, canvas.picture) = (size, png);
                    let _ = self.ui.borrow_mut().change_canvas(window, draw);
                }
            }
            Message::Event(name, text) => {
                let mut events = self.events.borrow_mut();
                if events.len() < MAX_WAITING {
                    events.push_back((name, text));
                }
            }
            Message::Said(level, text) => self.log(verbosity_of(level), &text),
            // Answers to questions that nobody waits for any more.
            Message::Answer(..) | Message::Refused(..) => {}
            Message::Hello(_) | Message::Lacks(_) | Message::Loaded | Message::Failed(_) => {}
        }
    }

    fn arrange(&self, number: i64, title: &str, visible: bool, size: [u32; 2], resizable: bool) {
        let mut windows = self.windows.borrow_mut();
        let mut ui = self.ui.borrow_mut();
        let window = windows
            .entry(number)
            .or_insert_with(|| ui.open_canvas(title, self.script));
        // The script may have destroyed it.
        let _ = ui.arrange_canvas(window, title, visible, size, resizable);
    }

    fn log(&self, level: i64, text: &str) {
        self.handler.log(level, &format!("simQML: {text}"));
    }

    /// Logs what the process wrote beside its messages.
    pub(super) fn log_output(&self) {
        let said = self.process.borrow().as_ref().and_then(Process::said);
        if let Some(text) = said {
            self.log(verbosity::SCRIPT_WARNINGS, &text);
        }
    }

    /// Sends the process what persons have done with its windows, and that pictures are wanted.
    pub(super) fn send_inputs(&self, is_seen: bool) {
        let windows = self.windows.borrow().clone();
        for (number, window) in windows {
            let inputs = self.ui.borrow_mut().take_canvas_inputs(&window);
            for input in inputs {
                self.send("input", &input_fields(number, input));
            }
            if is_seen {
                self.send("input", &[Data::Int(number), Data::text("want")]);
            }
        }
    }

    /// Whether a page has looked at windows since the last time.
    pub(super) fn is_seen(&self) -> bool {
        self.ui.borrow().take_asked()
    }

    /// Calls the handler of the script for the events that wait; those that come meanwhile wait for the next time.
    pub(super) fn deliver(&self) {
        let events = self.events.take();
        for (name, text) in events {
            let args = [
                Data::text(&self.handle),
                Data::text(&name),
                Data::Buffer(text),
            ];
            self.handler.call_logged(&args);
        }
    }

    /// Ends the process and closes the windows.
    pub(super) fn close(&self) {
        let windows = self.windows.take();
        drop(self.process.take());
        for window in windows.values() {
            if let Ok(mut ui) = self.ui.try_borrow_mut() {
                // The script may have destroyed it.
                let _ = ui.destroy(window);
            }
        }
    }
}

impl Drop for Engine {
    fn drop(&mut self) {
        self.close();
    }
}

fn verbosity_of(level: Level) -> i64 {
    match level {
        Level::Info => verbosity::SCRIPT_INFOS,
        Level::Warning => verbosity::SCRIPT_WARNINGS,
        Level::Error => verbosity::SCRIPT_ERRORS,
    }
}

/// The fields of an input, as they are sent to the process.
fn input_fields(number: i64, input: CanvasInput) -> Vec<Data> {
    let flags = |modifiers: ui::Modifiers| {
        [modifiers.shift, modifiers.control, modifiers.alt].map(Data::Bool)
    };
    let (what, fields) = match input {
        CanvasInput::Pointer(pointer) => (
            "pointer",
            [&pointed(pointer)[..], &flags(pointer.modifiers)].concat(),
        ),
        CanvasInput::Key {
            down,
            key,
            text,
            modifiers,
        } => {
            let pressed = [Data::Bool(down), Data::Int(key), Data::text(&text)];
            ("key", [&pressed[..], &flags(modifiers)].concat())
        }
        CanvasInput::Resize(size) => ("resize", size.map(Data::Int).to_vec()),
        CanvasInput::Close => ("close", Vec::new()),
    };
    [vec![Data::Int(number), Data::text(what)], fields].concat()
}

fn pointed(pointer: Pointer) -> [Data; 7] {
    let [x, y] = pointer.at.map(Data::Float);
    let [dx, dy] = pointer.delta.map(Data::Float);
    [
        Data::text(pointer.action.name()),
        x,
        y,
        Data::Int(pointer.button),
        Data::Int(pointer.buttons),
        dx,
        dy,
    ]
}
