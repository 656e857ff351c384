//! Who a session serves: a client at the other end of a connection, or one in this process.

use std::rc::Rc;
use std::time::Duration;

use script::Sim;
use serde_json::Value;

/// What comes from a client.
#[derive(Debug, Clone, PartialEq)]
pub enum Incoming {
    /// A client has come: what was known of the last one does not count.
    Connected,
    /// A message.
    Message(Value),
    /// The client is gone; a text says why it was sent away.
    Gone(Option<String>),
}

/// The client of a session, in messages of the Debug Adapter Protocol. All of it is called on the simulator's thread.
pub trait Client {
    /// What has come, if anything has.
    fn try_receive(&self) -> Option<Incoming>;

    /// The same after a wait; None when the time is over.
    fn receive(&self, timeout: Duration) -> Option<Incoming>;

    /// The same while everything stands still, so that others may look at the simulator meanwhile.
    fn receive_while_stopped(&self, _: &Rc<Sim>, timeout: Duration) -> Option<Incoming> {
        self.receive(timeout)
    }

    /// Sends a message to the client, if there is one.
    fn send(&self, message: &Value);

    /// Everything stands still there; None: it goes on. `handle` of the script (or null), `title` of the text and whether it `isOwn`
    /// text of that script, `line` from 1, `reason`, and `text`, a sentence or null.
    fn note_stop(&self, _place: Option<&Value>) {}

    /// From now on code that goes on for long after the client wants the end is asked again and again.
    fn force_end_on_request(&self) {}

    /// Waits until everything is written, but no longer than that.
    fn finish(&self, _timeout: Duration) {}
}
