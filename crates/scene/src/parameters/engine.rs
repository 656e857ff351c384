//! The parameters of physics engines: one table of their property names, defaults and the numbers they had before properties.
//!
//! Numbers and names are two ways to one value. Where values are stored is said in `engine_values`.

use heap::Lazy;
use std::collections::BTreeMap;

use crate::{Data, SceneError, SceneResult, ValueType};

/// `owner<TAB>name<TAB>type<TAB>flags<TAB>state<TAB>default<TAB>numbers<TAB>bit`, in the order of enumeration.
///
/// The state is `works` (the physics here uses it), `inert` (stored and read back) or `number` (inert, and no property). A list has a
/// number per element. `bit` is the number that joins switches of an engine, and the bit of this one. Defaults are those of the file
/// format and of the engines (spec: dynamics 5, dynamics 6); those of Vortex' switches, which neither states, are our choice.
const TABLE: &str = include_str!("engine.tsv");

/// The first real number of each engine is its step size: one for all here, a setting of the scene.
const STEP_SIZES: [i64; 5] = [1, 9001, 18_001, 27_001, 37_001];

/// A physics engine of CoppeliaSim (`sim.physics_*`). Scenes have parameters for each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Engine {
    /// Bullet 2.78 or 2.83.
    #[default]
    Bullet = 0,
    /// Open Dynamics Engine.
    Ode = 1,
    /// CM Labs Vortex.
    Vortex = 2,
    /// Newton Dynamics.
    Newton = 3,
    /// MuJoCo.
    Mujoco = 4,
}

impl Engine {
    /// All engines in the order of their numbers.
    pub const ALL: [Self; 5] = [
        Self::Bullet,
        Self::Ode,
        Self::Vortex,
        Self::Newton,
        Self::Mujoco,
    ];

    /// The engine with the number of `sim.physics_*`.
    pub fn from_number(number: i64) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|engine| engine.number() == number)
    }

    /// The number of `sim.physics_*`.
    pub fn number(self) -> i64 {
        self as i64
    }

    /// Prefix of the names of its parameters.
    pub fn name(self) -> &'static str {
        match self {
            Self::Bullet => "bullet",
            Self::Ode => "ode",
            Self::Vortex => "vortex",
            Self::Newton => "newton",
            Self::Mujoco => "mujoco",
        }
    }
}

/// The engine a scene selects, and its version (0: the first of Bullet). Both affect which of the parameters count.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct SelectedEngine {
    /// The engine.
    pub engine: Engine,
    /// Its version, e.g. 283 for Bullet 2.83.
    pub version: i64,
}

impl SelectedEngine {
    /// The engine with that number, in that version.
    ///
    /// # Errors
    /// When there is no such engine.
    pub fn from_numbers(number: i64, version: i64) -> SceneResult<Self> {
        let engine = Engine::from_number(number).ok_or(SceneError::InvalidArgument)?;
        Ok(Self { engine, version })
    }

    /// Number of the engine, version.
    pub fn numbers(self) -> [i64; 2] {
        [self.engine.number(), self.version]
    }
}

/// Owner of a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum EngineOwner {
    /// The scene: parameters of the simulation as a whole.
    Scene,
    /// The material of a shape.
    Material,
    /// A joint.
    Joint,
    /// A dummy.
    Dummy,
}

/// One parameter of one engine.
#[derive(Debug)]
pub struct EngineParam {
    /// What it is a parameter of.
    pub owner: EngineOwner,
    /// With the engine in front, e.g. `bullet.friction`.
    pub name: &'static str,
    /// Type of its values.
    pub ty: ValueType,
    /// The flags of the property.
    pub flags: i64,
    /// Whether the physics here uses it.
    pub works: bool,
    /// Whether scripts see it as a property.
    pub is_property: bool,
    /// The value of what was never set.
    pub default: Data,
}

/// Meaning of a number in the old API.
#[derive(Debug)]
pub(crate) enum Numbered {
    /// An element of a parameter; of one that is no list, the parameter itself.
    Element(&'static EngineParam, usize),
    /// Switches, each with its bit.
    Bits(Vec<(&'static EngineParam, i64)>),
}

impl EngineParam {
    /// The engine, and the name without it.
    pub fn split(&self) -> (&'static str, &'static str) {
        self.name.split_once('.').unwrap_or(("", self.name))
    }
}

/// The parameters of `owner`, in the order of enumeration.
pub fn engine_params(owner: EngineOwner) -> impl Iterator<Item = &'static EngineParam> {
    rows()
        .iter()
        .map(|(param, ..)| param)
        .filter(move |param| param.owner == owner)
}

/// A parameter with the numbers of its elements, and the number and the bit it shares with others.
type Row = (EngineParam, Vec<i64>, Option<(i64, i64)>);

fn rows() -> &'static [Row] {
    static ROWS: Lazy<Vec<Row>> = Lazy::new(|| TABLE.lines().map(row).collect());
    &ROWS
}

fn row(line: &'static str) -> Row {
    let fields: Vec<&'static str> = line.split('\t').collect();
    let [owner, name, ty, flags, state, default, numbers, bit] = fields[..] else {
        panic!("a line of engine.tsv has eight fields: {line}")
    };
    let ty = ValueType::from_word(ty).expect("engine.tsv holds known types");
    let integer =
        |text: &str| -> i64 { text.parse().expect("engine.tsv holds numbers as integers") };
    let param = EngineParam {
        owner: owner_of(owner).unwrap_or_else(|| panic!("an unknown owner in engine.tsv: {line}")),
        name,
        ty,
        flags: integer(flags),
        works: state == "works",
        is_property: state != "number",
        default: ty
            .parse(default)
            .expect("engine.tsv holds defaults of the row's type"),
    };
    let bit = bit
        .split_once(':')
        .map(|(number, bit)| (integer(number), integer(bit)));
    (
        param,
        numbers.split_whitespace().map(integer).collect(),
        bit,
    )
}

/// The owner whose part of the table of properties has that name.
fn owner_of(part: &str) -> Option<EngineOwner> {
    Some(match part {
        "dynamics" => EngineOwner::Scene,
        "material" => EngineOwner::Material,
        "joint" => EngineOwner::Joint,
        "dummy" => EngineOwner::Dummy,
        _ => return None,
    })
}

/// The parameter with that number (`sim.bullet_*`, `sim.ode_*` and so on).
pub(crate) fn numbered(number: i64) -> Option<&'static Numbered> {
    static NUMBERS: Lazy<BTreeMap<i64, Numbered>> = Lazy::new(numbers);
    NUMBERS.get(&number)
}

fn numbers() -> BTreeMap<i64, Numbered> {
    let mut all = BTreeMap::new();
    for (param, numbers, bit) in rows() {
        all.extend(
            numbers
                .iter()
                .enumerate()
                .map(|(at, &number)| (number, Numbered::Element(param, at))),
        );
        let Some((number, bit)) = *bit else { continue };
        match all
            .entry(number)
            .or_insert_with(|| Numbered::Bits(Vec::new()))
        {
            Numbered::Bits(switches) => switches.push((param, bit)),
            Numbered::Element(other, _) => panic!("{number} is {} and bits", other.name),
        }
    }
    all
}

/// Whether this old number is the step size of an engine.
pub fn is_step_size(number: i64) -> bool {
    STEP_SIZES.contains(&number)
}

#[cfg(test)]
mod tests {
    use super::{Data, Numbered, engine_params, numbered, rows};

    #[test]
    fn every_number_means_one_thing() {
        let elements: usize = rows().iter().map(|(_, numbers, _)| numbers.len()).sum();
        let found = rows().iter().flat_map(|(_, numbers, _)| numbers);
        let distinct: std::collections::BTreeSet<i64> = found.copied().collect();
        assert_eq!(distinct.len(), elements);
    }

    #[test]
    fn lists_have_as_many_numbers_as_elements() {
        for (param, numbers, _) in rows() {
            let length = if let Data::Array(items) = &param.default {
                items.len()
            } else {
                1
            };
            assert!(
                numbers.is_empty() || numbers.len() == length,
                "{}",
                param.name
            );
        }
    }

    #[test]
    fn names_are_those_of_the_property() {
        assert!(
            matches!(numbered(43_005), Some(Numbered::Element(param, 1)) if param.name == "mujoco.solref")
        );
        assert!(matches!(numbered(25_006), Some(Numbered::Bits(bits)) if bits.len() == 9));
        assert!(
            engine_params(super::EngineOwner::Joint).all(|param| param.split().1 != param.name)
        );
    }
}
