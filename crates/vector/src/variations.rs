//! What is different in each episode: values between bounds, written to the scene.

use rand_mt::Mt;
use scene::Data;
use simulator::{Simulator, property_getter, property_setter};

use crate::declaration::{Distribution, Scale, Target, Variation};
use crate::expressions::Expressions;
use crate::quantities::{Call, add_numbers, object, property};

/// `sim.handle_parent`.
const PARENT: i64 = -11;

/// The friction of a shape for each engine that a scene may select.
const FRICTIONS: &[&str] = &[
    "bullet.friction",
    "bullet.frictionOld",
    "ode.friction",
    "newton.staticFriction",
    "newton.kineticFriction",
    "mujoco.friction",
];

/// The variations of a scene.
pub(crate) struct Variations(Vec<Prepared>);

struct Prepared {
    low: Vec<f64>,
    high: Vec<f64>,
    distribution: Distribution,
    scale: Scale,
    places: Vec<Place>,
}

/// Where drawn numbers go.
enum Place {
    Scene {
        write: Call,
        /// The values of the scene.
        base: Vec<f64>,
        /// Whether it takes a list.
        is_list: bool,
    },
    ActionDelay,
}

impl Variations {
    pub(crate) fn new(
        simulator: &mut Simulator,
        expressions: &Expressions,
        all: &[Variation],
    ) -> Result<Self, String> {
        let prepared = all
            .iter()
            .map(|variation| prepare(simulator, expressions, variation));
        Ok(Self(prepared.collect::<Result<_, _>>()?))
    }

    /// Draws all of them in their order; the delay of actions, in steps.
    pub(crate) fn apply(
        &self,
        simulator: &mut Simulator,
        expressions: &Expressions,
        random: &mut Mt,
    ) -> Result<usize, String> {
        let mut delay = 0;
        for variation in &self.0 {
            let drawn = variation.draw(random);
            for place in &variation.places {
                match place {
                    Place::ActionDelay => {
                        delay = scene::numbers::place_of(scene::numbers::truncated(drawn[0]));
                    }
                    Place::Scene {
                        write,
                        base,
                        is_list,
                    } => {
                        let values = variation.values(base, &drawn);
                        let values = if *is_list {
                            Data::from(values)
                        } else {
                            Data::Float(values[0])
                        };
                        write.perform(simulator, expressions, &[values])?;
                    }
                }
            }
        }
        Ok(delay)
    }
}

impl Prepared {
    fn draw(&self, random: &mut Mt) -> Vec<f64> {
        let share = || f64::from(random.next_u32()) / 4_294_967_296.0;
        let shares = std::iter::repeat_with(share);
        let bounds = self.low.iter().zip(&self.high);
        let between = |((&low, &high), share): ((&f64, &f64), f64)| match self.distribution {
            Distribution::Uniform => low + (high - low) * share,
            Distribution::LogUniform => low * libm::pow(high / low, share),
        };
        bounds.zip(shares).map(between).collect()
    }

    /// What is written: one drawn number serves all values.
    fn values(&self, base: &[f64], drawn: &[f64]) -> Vec<f64> {
        let drawn = |at: usize| drawn[at.min(drawn.len() - 1)];
        let value = |(at, &base): (usize, &f64)| match self.scale {
            Scale::Absolute => drawn(at),
            Scale::Offset => base + drawn(at),
            Scale::Factor => base * drawn(at),
        };
        base.iter().enumerate().map(value).collect()
    }
}

fn prepare(
    simulator: &mut Simulator,
    expressions: &Expressions,
    variation: &Variation,
) -> Result<Prepared, String> {
    let what = variation.target.to_string();
    let places = places(simulator, expressions, &variation.target)
        .map_err(|error| format!("{what}: {error}"))?;
    check(variation, &places).map_err(|reason| format!("{what}: {reason}"))?;
    Ok(Prepared {
        low: variation.low.clone(),
        high: variation.high.clone(),
        distribution: variation.distribution,
        scale: variation.scale,
        places,
    })
}

fn check(variation: &Variation, places: &[Place]) -> Result<(), String> {
    let (low, high) = (&variation.low, &variation.high);
    let ordered = |(low, high): (&f64, &f64)| low <= high && low.is_finite() && high.is_finite();
    if low.is_empty() || low.len() != high.len() || !low.iter().zip(high).all(ordered) {
        return Err("a lower and an upper bound are needed.".into());
    }
    if variation.distribution == Distribution::LogUniform && low.iter().any(|&low| low <= 0.0) {
        return Err("bounds of a logarithmic distribution are above 0.".into());
    }
    for place in places {
        if let Place::Scene { base, .. } = place
            && low.len() != 1
            && low.len() != base.len()
        {
            return Err(format!(
                "it has {} numbers, the bounds have {}.",
                base.len(),
                low.len()
            ));
        }
    }
    Ok(())
}

fn places(
    simulator: &mut Simulator,
    expressions: &Expressions,
    target: &Target,
) -> Result<Vec<Place>, String> {
    let (read, write, args) = match target {
        Target::ActionDelay => return Ok(vec![Place::ActionDelay]),
        Target::Statement(text) => {
            let name = target.to_string();
            let number = expressions.compile(simulator, &name, "local x = ...;", text)?;
            return Ok(vec![Place::Scene {
                write: Call::Expression(number),
                base: vec![0.0],
                is_list: false,
            }]);
        }
        Target::Property(path, name) => {
            return Ok(vec![place_of_property(simulator, path, name)?]);
        }
        Target::Friction(path) => {
            let of = |name| place_of_property(simulator, path, name);
            return FRICTIONS.iter().copied().map(of).collect();
        }
        Target::Mass(path) => {
            let args = vec![Data::Int(object(simulator, path)?)];
            ("sim.getShapeMass", "sim.setShapeMass", args)
        }
        Target::Position(path) => {
            let args = vec![Data::Int(object(simulator, path)?), Data::Int(PARENT)];
            ("sim.getObjectPosition", "sim.setObjectPosition", args)
        }
        Target::Orientation(path) => {
            let args = vec![Data::Int(object(simulator, path)?), Data::Int(PARENT)];
            ("sim.getObjectOrientation", "sim.setObjectOrientation", args)
        }
    };
    // The value stands between the object and its frame.
    let read = Call::Api(simulator.prepare_call(read, args.clone()));
    let write = Call::Api(simulator.prepare_call(write, args));
    Ok(vec![place(simulator, &read, write)?])
}

fn place_of_property(simulator: &mut Simulator, path: &str, name: &str) -> Result<Place, String> {
    let read = property(simulator, path, name, property_getter)?;
    let write = property(simulator, path, name, property_setter)?;
    place(simulator, &read, write)
}

/// A place with the values that it has in the scene.
fn place(simulator: &mut Simulator, read: &Call, write: Call) -> Result<Place, String> {
    let results = read.perform(simulator, &Expressions::none(), &[])?;
    let mut base = Vec::new();
    match results.as_slice() {
        [value] if add_numbers(value, &mut base) && !base.is_empty() => Ok(Place::Scene {
            write,
            base,
            is_list: matches!(value, Data::Array(_)),
        }),
        _ => Err("it has no numbers.".into()),
    }
}

impl std::fmt::Display for Target {
    /// As errors name it.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Property(path, name) => write!(f, "the property {name} of {path}"),
            Self::Position(path) => write!(f, "the position of {path}"),
            Self::Orientation(path) => write!(f, "the orientation of {path}"),
            Self::Mass(path) => write!(f, "the mass of {path}"),
            Self::Friction(path) => write!(f, "the friction of {path}"),
            Self::ActionDelay => f.write_str("the delay of actions"),
            Self::Statement(text) => write!(f, "statement {text}"),
        }
    }
}
