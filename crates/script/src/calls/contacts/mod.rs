//! The callbacks that decide about contacts. They are called for every pair of shapes that may touch, hundreds of times per sub-step.

mod sole;

use std::rc::Rc;

use crate::host::Sim;
use crate::sys_call::SysCall;
use dynamics::ContactResponse;
use scene::parameters::engine::Engine;
use scene::{Data, Handle};
use sole::SoleResponder;

/// The callbacks that filter contacts: the old name first.
pub(crate) const CONTACT: [SysCall; 2] = [SysCall::ContactCallback, SysCall::Contact];
/// Both as bits.
const CONTACT_BITS: u64 = SysCall::ContactCallback.bit() | SysCall::Contact.bit();

/// The fields of the table that scripts get.
const FIELDS: [&str; 3] = ["handle1", "handle2", "engine"];

impl Sim {
    /// The answers about pairs of shapes, one after the other.
    pub(crate) fn ask_about_contacts(
        self: &Rc<Self>,
        pairs: &[(Handle, Handle)],
    ) -> Vec<ContactResponse> {
        let mut responses = Vec::with_capacity(pairs.len());
        while let Some(&(first, second)) = pairs.get(responses.len()) {
            match self.sole_responder() {
                Some(responder) => self.ask_sole_responder(&responder, pairs, &mut responses),
                None => responses.push(self.ask_about_contact(first, second)),
            }
        }
        responses
    }

    /// Asks the only script with an opinion about the next pairs, until it has one.
    fn ask_sole_responder(
        self: &Rc<Self>,
        responder: &SoleResponder,
        pairs: &[(Handle, Handle)],
        responses: &mut Vec<ContactResponse>,
    ) {
        let (known, mut engine) = (responses.len(), Engine::default());
        let (count, answer) = self.ask_in_turn(responder, &FIELDS, |number| {
            let &(first, second) = pairs.get(known + number)?;
            engine = self.engine();
            Some([first.raw(), second.raw(), engine.number()])
        });
        responses.resize(known + count, ContactResponse::Default);
        if let (Some(answer), Some(last)) = (answer, responses.last_mut()) {
            *last = response(&answer, engine);
        }
    }

    /// The answer of the first script that has one.
    pub(crate) fn ask_about_contact(
        self: &Rc<Self>,
        first: Handle,
        second: Handle,
    ) -> ContactResponse {
        let engine = self.engine();
        let values = [first.raw(), second.raw(), engine.number()];
        let arguments = [Data::map(
            [0, 1, 2].map(|field| (FIELDS[field], values[field].into())),
        )];
        let mut callbacks = CONTACT
            .into_iter()
            .filter(|&callback| self.scripts.may_respond(callback));
        let answer = callbacks.find_map(|callback| {
            self.first_answer(&self.active_scripts_reversed(), callback, &arguments)
        });
        answer.map_or(ContactResponse::Default, |answer| response(&answer, engine))
    }

    fn engine(&self) -> Engine {
        self.scene.borrow().settings().dynamics.engine.engine
    }
}

/// Decodes the table returned by `sysCall_contact` (spec: dynamics 4): values for the selected engine come first, then
/// those for Bullet.
fn response(answer: &Data, engine: Engine) -> ContactResponse {
    let number = |engine: &str, name: &str| {
        let nested = answer.field(engine).and_then(|table| table.field(name));
        nested
            .or_else(|| answer.field(&format!("{engine}.{name}")))
            .and_then(Data::as_f64)
    };
    let own = |[ode, newton]: [&str; 2]| match engine {
        Engine::Ode => number("ode", ode),
        Engine::Newton => number("newton", newton),
        _ => None,
    };
    match (
        answer.field("ignoreContact"),
        answer.field("collisionResponse"),
    ) {
        (Some(ignore), response) if !ignore.truthy() => match response.is_some_and(Data::truthy) {
            true => ContactResponse::Collide {
                friction: own(["mu", "kineticFriction"])
                    .or_else(|| number("bullet", "friction"))
                    .unwrap_or(1.0),
                restitution: own(["bounce", "restitution"])
                    .or_else(|| number("bullet", "restitution"))
                    .unwrap_or(0.0),
            },
            false => ContactResponse::NoCollision,
        },
        _ => ContactResponse::Default,
    }
}
