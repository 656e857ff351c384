//! Types, flags and parameters of particle objects (`sim.particle_*`).

use bitflags::bitflags;

use crate::drawing::options::{DrawingFlags, DrawingKind};

/// How particles are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ParticleKind {
    /// Points so many pixels wide.
    Points(u8),
    /// Balls.
    Spheres,
}

impl ParticleKind {
    /// The part of a type's number that is the kind; the bits above are [`ParticleFlags`].
    const MASK: i64 = 0x1f;

    /// The kind of a script's number.
    pub fn from_code(code: i64) -> Option<Self> {
        Some(match code & Self::MASK {
            0 => Self::Points(1),
            1 => Self::Points(2),
            2 => Self::Points(4),
            3 | 4 => Self::Spheres,
            _ => return None,
        })
    }

    pub(super) fn drawing(self) -> DrawingKind {
        match self {
            Self::Points(_) => DrawingKind::Points,
            Self::Spheres => DrawingKind::SpherePoints,
        }
    }
}

bitflags! {
    /// Flags in the type of a particle object.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct ParticleFlags: i64 {
        /// Collides with shapes that have one of the bits 1 to 4 of the global respondable mask.
        const RESPONDABLE_1_TO_4 = 0x20;
        /// The same with the bits 5 to 8.
        const RESPONDABLE_5_TO_8 = 0x40;
        /// Particles of the object collide with each other.
        const PARTICLE_RESPONDABLE = 0x80;
        /// Gravity does not pull.
        const IGNORES_GRAVITY = 0x100;
        /// Nobody sees them.
        const INVISIBLE = 0x200;
        /// Each item has a size after its velocity.
        const ITEM_SIZES = 0x400;
        /// Each item has a density after its size.
        const ITEM_DENSITIES = 0x800;
        /// Each item has a colour as its last numbers.
        const ITEM_COLOURS = 0x1000;
        /// A full object replaces its oldest item.
        const CYCLIC = 0x2000;
        /// Colours of items are what they emit.
        const EMISSION_COLOUR = 0x4000;
        /// Below height 0 is water, which bears them.
        const WATER = 0x8000;
        /// Visible to vision sensors, not only to cameras.
        const PAINT_TAG = 0x1_0000;
    }
}

impl ParticleFlags {
    /// The bits of the global respondable mask of shapes that the particles collide with.
    pub fn mask(self) -> u8 {
        let part = |flag: Self, bits: u8| if self.contains(flag) { bits } else { 0 };
        part(Self::RESPONDABLE_1_TO_4, 0x0f) | part(Self::RESPONDABLE_5_TO_8, 0xf0)
    }

    pub(super) fn drawing(self) -> DrawingFlags {
        let pairs = [
            (Self::ITEM_SIZES, DrawingFlags::ITEM_SIZES),
            (Self::ITEM_COLOURS, DrawingFlags::ITEM_COLOURS),
            (Self::EMISSION_COLOUR, DrawingFlags::EMISSION_COLOUR),
            (Self::PAINT_TAG, DrawingFlags::PAINT_TAG),
        ];
        let set = pairs.into_iter().filter(|(own, _)| self.contains(*own));
        set.map(|(_, drawn)| drawn).collect()
    }
}

/// The parameters of the physics: the number of a parameter is its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameters([f64; Self::COUNT]);

/// A parameter of the physics, by its number in scripts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parameter {
    /// Bullet's friction.
    BulletFriction = 0,
    /// Bullet's restitution.
    BulletRestitution = 1,
    /// ODE's friction.
    OdeFriction = 2,
    /// Resistance of what is around: force per speed, N s/m.
    LinearDrag = 6,
    /// Resistance of what is around: force per square of speed, N s²/m².
    QuadraticDrag = 7,
    /// As `LinearDrag`, of particles in water where they are above it.
    LinearDragInAir = 8,
    /// As `QuadraticDrag`, of particles in water where they are above it.
    QuadraticDragInAir = 9,
    /// Vortex' friction.
    VortexFriction = 10,
    /// Vortex' restitution.
    VortexRestitution = 11,
    /// Newton's friction of what slides.
    NewtonFriction = 17,
    /// Newton's restitution.
    NewtonRestitution = 18,
}

impl Default for Parameters {
    fn default() -> Self {
        Self([0.0; Self::COUNT])
    }
}

impl Parameters {
    const COUNT: usize = 19;

    /// From a script's numbers: how many there are, then the number and the value of each. What is not there, no number of a parameter, or negative is left out.
    pub fn from_numbers(numbers: &[f64]) -> Self {
        let mut parameters = Self::default();
        let count = numbers
            .first()
            .map_or(0, |count| ::numbers::index(count.max(0.0)));
        let pairs = numbers.get(1..).unwrap_or_default().as_chunks::<2>().0;
        for [number, value] in pairs.iter().take(count) {
            let place = parameters
                .0
                .iter_mut()
                .enumerate()
                .find(|(place, _)| *place as f64 == *number);
            if let Some((_, place)) = place
                && value.is_finite()
                && *value >= 0.0
            {
                *place = *value;
            }
        }
        parameters
    }

    /// The value of one.
    pub fn get(&self, parameter: Parameter) -> f64 {
        self.0[parameter as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_are_a_count_and_pairs() {
        let numbers = [3.0, 1.0, 0.2, 7.0, 0.5, 6.0, -1.0, 0.0, 9.0];
        let parameters = Parameters::from_numbers(&numbers);
        assert_eq!(parameters.get(Parameter::BulletRestitution), 0.2);
        assert_eq!(parameters.get(Parameter::QuadraticDrag), 0.5);
        // Negative, and beyond the count.
        assert_eq!(parameters.get(Parameter::LinearDrag), 0.0);
        assert_eq!(parameters.get(Parameter::BulletFriction), 0.0);
    }

    #[test]
    fn what_is_no_list_of_parameters_says_nothing() {
        let lists: [&[f64]; 6] = [
            &[],
            &[f64::NAN, 1.0, 2.0],
            &[-3.0, 1.0, 2.0],
            &[1.0, 99.0, 2.0],
            &[1.0, 1.5, 2.0],
            &[1e300, 1.0, f64::INFINITY, 1.0],
        ];
        for list in lists {
            assert_eq!(
                Parameters::from_numbers(list),
                Parameters::default(),
                "{list:?}"
            );
        }
    }

    #[test]
    fn masks_are_halves() {
        let both = ParticleFlags::from_bits_truncate(32 + 64);
        assert_eq!(
            [both.mask(), ParticleFlags::from_bits_truncate(64).mask()],
            [0xff, 0xf0]
        );
        assert_eq!(ParticleFlags::empty().mask(), 0);
    }

    #[test]
    fn kinds_have_their_numbers() {
        let kinds = [0, 1, 2, 3, 4, 5].map(|code| ParticleKind::from_code(32 + code));
        use ParticleKind::{Points, Spheres};
        let spheres = Some(Spheres);
        assert_eq!(
            kinds,
            [
                Some(Points(1)),
                Some(Points(2)),
                Some(Points(4)),
                spheres,
                spheres,
                None
            ]
        );
    }
}
