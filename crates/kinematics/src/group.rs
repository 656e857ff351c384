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
            /// The id of a script's number; None where it is negative. Whether it exists is checked when it is used.
            pub fn from_raw(raw: i64) -> Option<Self> {
                usize::try_from(raw).ok().map(Self)
            }

            /// The number that scripts know.
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

            /// Whether all bits of `other` are set.
            pub fn contains(self, other: Self) -> bool {
                self.0 & other.0 == other.0
            }

            /// Whether any bit of `other` is set.
            pub fn intersects(self, other: Self) -> bool {
                self.0 & other.0 != 0
            }

            /// Whether no bit is set.
            pub fn is_empty(self) -> bool {
                self.0 == 0
            }

            /// Sets the bits of `other`.
            pub fn insert(&mut self, other: Self) {
                self.0 |= other.0;
            }

            /// Clears the bits of `other`.
            pub fn remove(&mut self, other: Self) {
                self.0 &= !other.0;
            }
        }
    };
}

bits! {
    /// The axes in which a tip has to reach its target.
    Constraints {
        /// The position along x.
        X = 1;
        /// The position along y.
        Y = 2;
        /// The position along z.
        Z = 4;
        /// The z axes are parallel.
        ALPHA_BETA = 8;
        /// The rotation about z.
        GAMMA = 16;
        /// All three axes of the position.
        POSITION = 7;
        /// The whole orientation.
        ORIENTATION = 24;
        /// Position and orientation.
        POSE = 31;
    }
}

bits! {
    /// How a group is handled.
    GroupFlags {
        /// The group is handled.
        ENABLED = 1;
        /// Steps of joints may exceed their largest ones.
        IGNORE_MAX_STEPS = 2;
        /// Joints return to where they were when the linear precision is missed.
        RESTORE_ON_BAD_LINEAR = 4;
        /// The same for the angular precision.
        RESTORE_ON_BAD_ANGULAR = 8;
        /// The calculation ends where a joint reaches a limit.
        STOP_ON_LIMIT_HIT = 16;
        /// Joints near a limit are pushed away from it.
        AVOID_LIMITS = 64;
    }
}

bits! {
    /// What went wrong in a calculation; nothing if it succeeded.
    Flags {
        /// Nothing was calculated: a group is disabled or has no valid element.
        NOT_PERFORMED = 1;
        /// The equations cannot be solved.
        CANNOT_INVERT = 2;
        /// Errors exceed the precision of an element.
        NOT_WITHIN_TOLERANCE = 16;
        /// Steps exceeded the largest ones of joints and were reduced.
        STEPS_TOO_BIG = 32;
        /// A joint reached a limit.
        LIMIT_HIT = 64;
        /// A callback returned data that cannot be used.
        INVALID_CALLBACK_DATA = 128;
    }
}

/// How steps are computed from errors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// With a damping of 1e-6.
    PseudoInverse = 0,
    /// With the group's damping.
    DampedLeastSquares = 1,
    /// The transpose of the Jacobian takes the place of its inverse.
    JacobianTranspose = 2,
    /// Without damping: fails where the Jacobian is singular.
    UndampedPseudoInverse = 3,
}

impl Method {
    /// The method of a script's number.
    pub fn from_raw(raw: i64) -> Option<Self> {
        [
            Self::PseudoInverse,
            Self::DampedLeastSquares,
            Self::JacobianTranspose,
            Self::UndampedPseudoInverse,
        ]
        .into_iter()
        .find(|method| *method as i64 == raw)
    }
}

/// A joint that was stopped at its limit, and how far beyond it would have gone: negative below the lower one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LimitHit {
    /// The joint.
    pub joint: ObjectId,
    /// Distance beyond the limit, rad or m.
    pub overshoot: f64,
}

/// Elements that are satisfied together.
#[derive(Debug, Clone)]
pub struct Group {
    /// Name, by which the group can be found.
    pub name: String,
    /// How steps are computed.
    pub method: Method,
    /// Damping of [`Method::DampedLeastSquares`].
    pub damping: f64,
    /// At most; at least one is done.
    pub iterations: u32,
    /// How the group is handled.
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
    /// Whether the element counts.
    pub enabled: bool,
    /// The dummy that has to reach its target.
    pub tip: ObjectId,
    /// The chain ends here; None: at the world.
    pub base: Option<ObjectId>,
    /// The frame of the constraints, where it is another one than the base.
    pub constraint_base: Option<ObjectId>,
    /// The axes in which it has to.
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
