//! Messages as lines: standard input and output.

use std::io::{BufRead, BufReader, Read, Result, Write};
use std::rc::Rc;
use std::sync::mpsc::{Receiver, Sender, SyncSender, channel, sync_channel};

use serde_json::Value;

use super::message::{Fault, code, parse};
use super::progress::Notify;
use super::running::Running;
use super::service::Service;
use super::session::Session;

/// Bytes of a message; longer ones are refused.
pub const MAX_LINE: usize = 64 << 20;
/// Lines that wait for their turn.
const QUEUE: usize = 256;

/// A line, or that it was too long.
type Line = Option<Vec<u8>>;

/// Answers the lines of `input` until it ends. Lines are read on a thread of their own, so that a call can be cancelled, and written on
/// another one, so that a call can say how far it is.
///
/// # Errors
/// When an answer cannot be written.
pub fn serve(
    service: &mut dyn Service,
    input: impl Read + Send + 'static,
    output: &mut (dyn Write + Send),
    running: &Running,
) -> Result<()> {
    let (sender, lines) = sync_channel(QUEUE);
    let reading = running.clone();
    std::thread::Builder::new()
        .name("messages".into())
        .spawn(move || read_lines(input, &sender, &reading))?;
    std::thread::scope(|threads| {
        let (answers, written) = channel();
        let writing = threads.spawn(move || write_lines(output, &written));
        answer_lines(service, &lines, answers, running);
        writing
            .join()
            .unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    })
}

fn write_lines(output: &mut dyn Write, answers: &Receiver<Value>) -> Result<()> {
    for answer in answers {
        output.write_all(format!("{answer}\n").as_bytes())?;
        output.flush()?;
    }
    Ok(())
}

fn answer_lines(
    service: &mut dyn Service,
    lines: &Receiver<Line>,
    answers: Sender<Value>,
    running: &Running,
) {
    let mut session = Session::default();
    let notes = answers.clone();
    // Where nobody reads any more, the next answer shows it.
    let notify: Notify = Rc::new(move |note| drop(notes.send(note)));
    for line in lines {
        let messages = match line {
            Some(line) => parse(&line),
            None => Err(Fault::new(
                code::INVALID_REQUEST,
                format!("a message has at most {} MiB", MAX_LINE >> 20),
            )),
        };
        let is_wanted = messages
            .as_ref()
            .map_or(true, |messages| running.begin("", messages));
        let answer = is_wanted
            .then(|| session.answer(service, messages, &notify))
            .flatten();
        let is_awaited = running.end();
        if let Some(answer) = answer.filter(|_| is_awaited)
            && answers.send(answer).is_err()
        {
            return;
        }
    }
}

fn read_lines(input: impl Read, sender: &SyncSender<Line>, running: &Running) {
    let mut input = BufReader::new(input);
    while let Ok(Some(line)) = next_line(&mut input) {
        if line
            .as_ref()
            .is_some_and(|line| line.trim_ascii().is_empty())
        {
            continue;
        }
        // Anything else waits for its turn.
        if let Some(Ok(messages)) = line.as_deref().map(parse) {
            running.handle_cancellations("", &messages);
        }
        if sender.send(line).is_err() {
            return;
        }
    }
}

/// The next line; None at the end of the input.
fn next_line(input: &mut impl BufRead) -> Result<Option<Line>> {
    let mut line = Vec::new();
    let limit = MAX_LINE as u64 + 1;
    if input.by_ref().take(limit).read_until(b'\n', &mut line)? == 0 {
        return Ok(None);
    }
    if line.len() <= MAX_LINE || line.ends_with(b"\n") {
        return Ok(Some(Some(line)));
    }
    skip_line(input)?;
    Ok(Some(None))
}

/// Reads to the end of a line that nobody keeps.
fn skip_line(input: &mut impl BufRead) -> Result<()> {
    loop {
        let part = input.fill_buf()?;
        let end = part.iter().position(|byte| *byte == b'\n');
        let length = end.map_or(part.len(), |end| end + 1);
        input.consume(length);
        if length == 0 || end.is_some() {
            return Ok(());
        }
    }
}
