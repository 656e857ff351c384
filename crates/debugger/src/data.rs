//! Data breakpoints: properties of objects whose change stops the code.

use std::rc::Rc;

use scene::object::script_object::ScriptType;
use scene::{Data, Handle, ValueType};
use script::Sim;
use serde_json::{Value, json};

use crate::breakpoints::Rule;
use crate::objects::shown;

/// A property that is watched.
pub struct Watched {
    /// Its number, for clients.
    pub id: u64,
    /// When a change stops the code.
    pub rule: Rule,
    /// How often it has changed.
    pub hits: u64,
    /// As the client named it: `/Box.pose`.
    pub name: String,
    /// What the name stands for, once it is there: it stays the same when the object gets another name.
    property: Option<Property>,
    /// What was read last; None until the object is there.
    last: Option<Data>,
}

/// A property of an object.
#[derive(Clone)]
struct Property {
    handle: i64,
    name: String,
    ty: ValueType,
}

/// A change of a watched property.
pub struct Change {
    /// The number of the breakpoint.
    pub id: u64,
    /// A sentence.
    pub text: String,
}

/// All watched properties.
#[derive(Default)]
pub struct DataBreakpoints {
    watched: Vec<Watched>,
}

/// Numbers begin here, so that they are not those of other breakpoints.
const FIRST_ID: u64 = 1 << 32;

/// The name of a property of an object, for [`DataBreakpoints::set`].
pub fn name(sim: &Rc<Sim>, handle: i64, property: &str) -> Option<String> {
    let path = sim.copied_out(|sim| {
        let scene = sim.scene.try_borrow().ok()?;
        scene.short_path(Handle::from_raw(handle)?).ok()
    })?;
    Some(format!("{path}.{property}"))
}

/// Whether that is the name of a property of an object that is there.
pub fn exists(sim: &Rc<Sim>, name: &str) -> bool {
    find(sim, name).is_some()
}

impl DataBreakpoints {
    /// Replaces all; the answers for the client.
    pub fn set(&mut self, sim: Option<&Rc<Sim>>, requested: &[Value]) -> Vec<Value> {
        self.watched.clear();
        let mut answers = Vec::new();
        for (id, requested) in (FIRST_ID..).zip(requested) {
            let name = requested["dataId"].as_str().unwrap_or_default();
            let rule = match Rule::parse(requested) {
                Ok(rule) if name.contains(['.', ':']) && rule.condition.is_none() => rule,
                Ok(rule) => {
                    let reason = match rule.condition {
                        Some(_) => "data breakpoints have no conditions here, only hit counts",
                        None => "a property is named such as /Box.pose",
                    };
                    answers.push(json!({"verified": false, "message": reason}));
                    continue;
                }
                Err(reason) => {
                    answers.push(json!({"verified": false, "message": reason}));
                    continue;
                }
            };
            let property = sim.and_then(|sim| find(sim, name));
            let last = sim.and_then(|sim| property.as_ref()?.read(sim));
            answers.push(json!({"id": id, "verified": last.is_some() || sim.is_none()}));
            self.watched.push(Watched {
                id,
                rule,
                hits: 0,
                name: name.to_owned(),
                property,
                last,
            });
        }
        answers
    }

    /// Whether nothing is watched.
    pub fn is_empty(&self) -> bool {
        self.watched.is_empty()
    }

    /// Whether all that is watched was there.
    pub fn has_values(&self) -> bool {
        self.watched.iter().all(|watched| watched.last.is_some()) && !self.is_empty()
    }

    /// Reads what is there: the simulation was brought to another moment.
    pub fn refresh(&mut self, sim: &Rc<Sim>) {
        for watched in &mut self.watched {
            watched.property = find(sim, &watched.name);
            watched.last = watched
                .property
                .as_ref()
                .and_then(|property| property.read(sim));
        }
    }

    /// What has changed since the last time. Without `counts`, on the way to another moment, hit counts do not matter.
    pub fn changes(&mut self, sim: &Rc<Sim>, counts: bool) -> Vec<Change> {
        let mut changes = Vec::new();
        for watched in &mut self.watched {
            if watched.property.is_none() {
                watched.property = find(sim, &watched.name);
            }
            let now = watched
                .property
                .as_ref()
                .and_then(|property| property.read(sim));
            let before = std::mem::replace(&mut watched.last, now);
            let (Some(before), Some(now)) = (&before, &watched.last) else {
                continue;
            };
            if is_same(before, now) {
                continue;
            }
            watched.hits += u64::from(counts);
            let count = watched.rule.count.filter(|_| counts);
            if count.is_none_or(|count| count.holds(watched.hits)) {
                let text = format!("{}: {} became {}", watched.name, shown(before), shown(now));
                changes.push(Change {
                    id: watched.id,
                    text,
                });
            }
        }
        changes
    }
}

/// Whether two values are the same, bit for bit: not a number is the same as itself here.
fn is_same(a: &Data, b: &Data) -> bool {
    a == b || format!("{a:?}") == format!("{b:?}")
}

impl Property {
    fn read(&self, sim: &Rc<Sim>) -> Option<Data> {
        sim.copied_out(|sim| {
            let sandbox = sim.scripts.detached(ScriptType::Sandbox)?;
            let target = sim.property_target(self.handle, &sandbox).ok()?;
            sim.read_property(&target, &self.name, self.ty).ok()
        })
    }
}

/// The property with that name: the path of an object, and what is behind a dot.
fn find(sim: &Rc<Sim>, name: &str) -> Option<Property> {
    // In the words of debuggers `/Box.pose`, in those of the reference `/Box:pose`.
    let mut borders = name.match_indices(['.', ':']);
    borders.find_map(|(at, _)| {
        let (path, name) = (&name[..at], &name[at + 1..]);
        let (handle, ty) = sim.copied_out(|sim| {
            let sandbox = sim.scripts.detached(ScriptType::Sandbox)?;
            let handle = sim.scene.try_borrow().ok()?.find(path, None, None).ok()?;
            let target = sim.property_target(handle.raw(), &sandbox).ok()?;
            Some((handle.raw(), sim.property_info(&target, name)?.0))
        })?;
        let name = name.to_owned();
        Some(Property { handle, name, ty })
    })
}
