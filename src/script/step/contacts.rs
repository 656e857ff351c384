//! The callbacks that decide about contacts. They are called for every pair of shapes that may touch, hundreds of times per sub-step.

use std::cell::Cell;
use std::rc::Rc;

use crate::dynamics::ContactResponse;
use crate::scene::parameters::engine::Engine;
use crate::scene::{Data, Handle};
use crate::script::calls::callback::SysCall;
use crate::script::sim::Sim;

/// The callbacks that filter contacts: the old name first.
pub(super) const CONTACT: [SysCall; 2] = [SysCall::ContactCallback, SysCall::Contact];

/// The table that scripts get, of the pair before. Making a new one would take as long as the call.
#[derive(Default)]
pub(super) struct Question(Cell<Vec<Data>>);

impl Question {
    /// The arguments of the callbacks.
    fn about(&self, first: Handle, second: Handle, engine: Engine) -> Vec<Data> {
        let mut arguments = self.0.take();
        if arguments.is_empty() {
            arguments = vec![Data::map(["handle1", "handle2", "engine"].map(|key| (key, Data::Nil)))];
        }
        if let [Data::Map(entries)] = &mut arguments[..] {
            for ((_, known), value) in entries.iter_mut().zip([first.raw(), second.raw(), engine.number()]) {
                *known = Data::Int(value);
            }
        }
        arguments
    }
}

impl Sim {
    /// The answer of the first script that has one.
    pub(super) fn ask_about_contact(
        self: &Rc<Self>,
        question: &Question,
        first: Handle,
        second: Handle,
    ) -> ContactResponse {
        let engine = self.scene.borrow().settings().dynamics.engine.engine;
        let arguments = question.about(first, second, engine);
        let mut callbacks = CONTACT.into_iter().filter(|&callback| self.scripts.may_respond(callback));
        let answer =
            callbacks.find_map(|callback| self.first_answer(&self.active_scripts_reversed(), callback, &arguments));
        question.0.set(arguments);
        answer.map_or(ContactResponse::Default, |answer| response(&answer, engine))
    }
}

/// Decodes the table returned by `sysCall_contact` (spec: dynamics 4): values for the selected engine come first, then
/// those for Bullet.
fn response(answer: &Data, engine: Engine) -> ContactResponse {
    let number = |engine: &str, name: &str| {
        let nested = answer.field(engine).and_then(|table| table.field(name));
        nested.or_else(|| answer.field(&format!("{engine}.{name}"))).and_then(Data::as_f64)
    };
    let own = |[ode, newton]: [&str; 2]| match engine {
        Engine::Ode => number("ode", ode),
        Engine::Newton => number("newton", newton),
        _ => None,
    };
    match (answer.field("ignoreContact"), answer.field("collisionResponse")) {
        (Some(ignore), response) if !ignore.truthy() => match response.is_some_and(Data::truthy) {
            true => ContactResponse::Collide {
                friction: own(["mu", "kineticFriction"]).or_else(|| number("bullet", "friction")).unwrap_or(1.0),
                restitution: own(["bounce", "restitution"]).or_else(|| number("bullet", "restitution")).unwrap_or(0.0),
            },
            false => ContactResponse::NoCollision,
        },
        _ => ContactResponse::Default,
    }
}
