//! Dialogs of scripts that wait for a person: the simulation's thread shows the question to the pages and waits, as the calling script does.

use std::time::Duration;

use serde_json::{Value, json};

use super::request::Action;
use super::server::{Pending, Shared};
use io::SiteWaker;
use scene::Data;
use ui::{Question, answer_of_page};

/// How often the wait for an answer checks whether any page is still connected.
const POLL_INTERVAL: Duration = Duration::from_millis(100);

/// Shows a question to all pages until one answers. None when it is cancelled, and when there are no pages that may answer, or no longer.
pub(super) fn ask(
    shared: &Shared,
    waker: &SiteWaker,
    question: &Question,
    is_ending: &dyn Fn() -> bool,
) -> Option<Data> {
    if !shared.has_persons() {
        return None;
    }
    let number = shared.number_question();
    shared.mirror().show_question(&question.json(number));
    waker.wake();
    shared.set_asking(true);
    let answer = wait(shared, waker, number, is_ending);
    shared.set_asking(false);
    shared.mirror().show_question(&Value::Null);
    waker.wake();
    answer
}

fn wait(
    shared: &Shared,
    waker: &SiteWaker,
    number: u64,
    is_ending: &dyn Fn() -> bool,
) -> Option<Data> {
    while shared.has_persons() && !is_ending() {
        let Some(pending) = shared.next_request(POLL_INTERVAL) else {
            continue;
        };
        let answered = answer_to(&pending, number);
        let waits = || "a script waits for the answer to its dialog".to_owned();
        pending.answer(answered.map(|_| json!(true)).ok_or_else(waits));
        waker.wake();
        if let Some(answer) = answered {
            return answer_of_page(answer);
        }
    }
    None
}

/// The answer in a request, if it is one to this question.
fn answer_to(pending: &Pending, number: u64) -> Option<&Value> {
    match &pending.action {
        Action::Answer { question, answer } if *question == number => Some(answer),
        _ => None,
    }
}
