//! The lines of `static.tsv`.

use super::descriptions::description;
use ::scene::ValueType;
use ::scene::parameters::engine::{EngineOwner, EngineParam, engine_params};

/// `part<TAB>name<TAB>type<TAB>flags<TAB>state<TAB>default`, in the order of enumeration within a part.
///
/// The state is `works`, `inert` (stored and read back, no effect) or `constant` (always the default); what works has an accessor, and
/// what needs more than storage may have one. An empty default is false, 0, no text, an empty list, the origin or no rotation; numbers
/// in lists are separated by spaces. A list that has a default keeps its length. In place of a default, what works may have the name of the
/// property it is an older word for.
const STATIC: &str = include_str!("../static.tsv");

/// A line of `static.tsv`.
pub struct Line {
    /// The part of a class it belongs to, such as `object` or `joint`.
    pub part: &'static str,
    /// Its name, without the class.
    pub name: &'static str,
    /// The type of its value.
    pub ty: ValueType,
    /// Bits of [`flags`].
    pub flags: i64,
    /// `works`, `inert` or `constant`.
    pub state: &'static str,
    pub(super) default: &'static str,
    /// What it is, in a sentence.
    pub description: &'static str,
}

pub(super) fn lines() -> impl Iterator<Item = Line> {
    STATIC.lines().map(|line| {
        let fields: Vec<&'static str> = line.split('\t').collect();
        let [part, name, ty, flags, state, default] = fields[..] else {
            panic!("a line of static.tsv has six fields: {line}")
        };
        let ty = ValueType::from_word(ty).expect("static.tsv holds known types");
        let flags = flags.parse().expect("static.tsv holds flags as integers");
        Line {
            part,
            name,
            ty,
            flags,
            state,
            default,
            description: description(part, described_as(name, state, default)),
        }
    })
}

/// The name under which a property is described: that of the one it is an older word for.
fn described_as(name: &'static str, state: &str, default: &'static str) -> &'static str {
    if state == "works" && !default.is_empty() {
        default
    } else {
        name
    }
}

/// Every static property for the reference, those of physics engines after the others.
pub fn described() -> Vec<Line> {
    let engine_line = |part: &'static str, param: &'static EngineParam| Line {
        part,
        name: param.name,
        ty: param.ty,
        flags: param.flags,
        state: if param.works { "works" } else { "inert" },
        default: "",
        description: description(part, param.name),
    };
    let engines = ENGINE_PARTS.into_iter().flat_map(|(part, owner)| {
        engine_params(owner)
            .filter(|param| param.is_property)
            .map(move |param| engine_line(part, param))
    });
    lines().chain(engines).collect()
}

/// The parts that end with parameters of physics engines.
pub(super) const ENGINE_PARTS: [(&str, EngineOwner); 4] = [
    ("dynamics", EngineOwner::Scene),
    ("material", EngineOwner::Material),
    ("joint", EngineOwner::Joint),
    ("dummy", EngineOwner::Dummy),
];
