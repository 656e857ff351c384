//! Groups and their elements: what the solver has to reach, and how.

use crate::chain::Chains;
use crate::equations::Equations;
use crate::object::ObjectId;

/// Number of a group in its environment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct GroupId(pub(crate) usize);

/// Number of an element in its group.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct ElementId(pub(crate) usize);

macro_rules! ids {
    ($($id:ident),*) => { $(
        impl $id {
            pub fn from_raw(raw: i64) -> Option<Self> {
                usize::try_from(raw).ok().map(Self)
            }

            pub fn raw(self) -> i64 {
                self.0 as i64
            }
        }
    )* };
}
ids!(GroupId, ElementId);

macro_rules! bits {
    ($(#[$doc:meta])* $name:ident { $($(#[$bit_doc:meta])* $bit:ident = $value:expr;)* }) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
        pub struct $name(pub u32);

        impl $name {
            $($(#[$bit_doc])* pub const $bit: Self = Self($value);)*

            pub fn contains(self, other: Self) -> bool {
                self.0 & other.0 == other.0
            }

            pub fn intersects(self, other: Self) -> bool {
                self.0 & other.0 != 0
            }

            pub fn is_empty(self) -> bool {
                self.0 == 0
            }

            pub fn insert(&mut self, other: Self) {
                self.0 |= other.0;
            }

            pub fn remove(&mut self, other: Self) {
                self.0 &= !other.0;
            }
        }
    };
}

bits! {
    /// The axes in which a tip has to reach its target.
    Constraints {
        X = 1;
        Y = 2;
        Z = 4;
        /// The z axes are parallel.
        ALPHA_BETA = 8;
        /// The rotation about z.
        GAMMA = 16;
        POSITION = 7;
        ORIENTATION = 24;
        POSE = 31;
    }
}

bits! {
    /// How a group is handled.
    GroupFlags {
        ENABLED = 1;
        IGNORE_MAX_STEPS = 2;
        /// Joints return to where they were when the linear precision is missed.
        RESTORE_ON_BAD_LINEAR = 4;
        /// The same for the angular precision.
        RESTORE_ON_BAD_ANGULAR = 8;
        STOP_ON_LIMIT_HIT = 16;
        AVOID_LIMITS = 64;
    }
}

bits! {
    /// What went wrong in a calculation; nothing if it succeeded.
    Flags {
        NOT_PERFORMED = 1;
        CANNOT_INVERT = 2;
        NOT_WITHIN_TOLERANCE = 16;
        STEPS_TOO_BIG = 32;
        LIMIT_HIT = 64;
        INVALID_CALLBACK_DATA = 128;
    }
}

/// How steps are computed from errors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// With a damping of 1e-6.
    PseudoInverse = 0,
    DampedLeastSquares = 1,
    JacobianTranspose = 2,
    UndampedPseudoInverse = 3,
}

impl Method {
    pub fn from_raw(raw: i64) -> Option<Self> {
        [Self::PseudoInverse, Self::DampedLeastSquares, Self::JacobianTranspose, Self::UndampedPseudoInverse]
            .into_iter()
            .find(|method| *method as i64 == raw)
    }
}

/// A joint that was stopped at its limit, and how far beyond it would have gone: negative below the lower one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LimitHit {
    pub joint: ObjectId,
    pub overshoot: f64,
}

/// Elements that are satisfied together.
#[derive(Debug, Clone)]
pub struct Group {
    pub name: String,
    pub method: Method,
    pub damping: f64,
    /// At most; at least one is done.
    pub iterations: u32,
    pub flags: GroupFlags,
    pub(crate) elements: Vec<Option<Element>>,
    pub(crate) limit_hits: Vec<LimitHit>,
    pub(crate) chains: Option<Chains>,
    pub(crate) equations: Equations,
}

impl Group {
    pub(crate) fn new(name: &str) -> Self {
        Self {
            name: name.into(),
            method: Method::PseudoInverse,
            damping: 0.1,
            iterations: 3,
            flags: GroupFlags(3),
            elements: Vec::new(),
            limit_hits: Vec::new(),
            chains: None,
            equations: Equations::default(),
        }
    }

    /// With their numbers.
    pub fn elements(&self) -> impl Iterator<Item = (ElementId, &Element)> {
        let numbered = self.elements.iter().enumerate();
        numbered.filter_map(|(i, element)| Some((ElementId(i), element.as_ref()?)))
    }

    /// Of the last calculation.
    pub fn limit_hits(&self) -> &[LimitHit] {
        &self.limit_hits
    }
}

/// A tip that has to reach its target.
#[derive(Debug, Clone, PartialEq)]
pub struct Element {
    pub enabled: bool,
    pub tip: ObjectId,
    /// The chain ends here; None: at the world.
    pub base: Option<ObjectId>,
    /// The frame of the constraints, where it is another one than the base.
    pub constraint_base: Option<ObjectId>,
    pub constraints: Constraints,
    /// Largest linear (m) and angular (rad) error.
    pub precision: [f64; 2],
    /// Factors of linear errors, of angular errors, of both.
    pub weights: [f64; 3],
}

impl Element {
    pub(crate) fn new(tip: ObjectId) -> Self {
        Self {
            enabled: true,
            tip,
            base: None,
            constraint_base: None,
            constraints: Constraints::POSITION,
            precision: [0.0005, 0.1_f64.to_radians()],
            weights: [1.0; 3],
        }
    }
}
