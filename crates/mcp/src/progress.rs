//! How far a call is: what the client is told meanwhile, if it asked for that.

use std::cell::Cell;
use std::rc::Rc;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

/// Takes what is said while a request is answered.
pub type Notify = Rc<dyn Fn(Value)>;

/// Between two messages about the same call; the first one comes that long after its begin.
const PERIOD: Duration = Duration::from_millis(250);

/// Where a tool says how far it is. Does nothing if the client did not ask.
#[derive(Clone, Default)]
pub struct Progress(Option<Rc<Report>>);

struct Report {
    /// The client's name of the request.
    token: Value,
    notify: Notify,
    next: Cell<Instant>,
    /// How much was done at the last message: it grows from one to the next.
    done: Cell<f64>,
}

impl Progress {
    /// Of a request with these parameters.
    pub(crate) fn of(params: &Value, notify: &Notify) -> Self {
        let token = &params["_meta"]["progressToken"];
        let is_wanted = token.is_string() || token.is_number();
        Self(is_wanted.then(|| {
            Rc::new(Report {
                token: token.clone(),
                notify: notify.clone(),
                next: Cell::new(now() + PERIOD),
                done: Cell::new(f64::NEG_INFINITY),
            })
        }))
    }

    /// Says that so much is done, of a total if that is known. Costs little where nothing is to be said.
    pub fn report(&self, done: f64, total: Option<f64>, message: impl FnOnce() -> String) {
        let Some(report) = &self.0 else { return };
        let time = now();
        if time < report.next.get() || done <= report.done.get() {
            return;
        }
        report.next.set(time + PERIOD);
        report.done.set(done);
        let mut params =
            json!({"progressToken": report.token, "progress": done, "message": message()});
        if let Some(total) = total {
            params["total"] = total.into();
        }
        (report.notify)(
            json!({"jsonrpc": "2.0", "method": "notifications/progress", "params": params}),
        );
    }
}

#[expect(
    clippy::disallowed_methods,
    reason = "people and models wait by the wall clock; nothing of a simulation comes from here"
)]
fn now() -> Instant {
    Instant::now()
}
