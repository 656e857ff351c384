//! Paths from before 4.2.

use super::Colour;
use crate::ttt::stream::streams;
use crate::ttt::value::{Counted, PositionFirst};

streams! {
    /// A path of the kind that was replaced in 4.2.
    Path until b"EOO" {
        /// Bit0 shaping on, bit1 full orientation, bit2 closed section, bit3 convex hull, bit5 explicit.
        flags: Option<u8> = b"Var",
        shaping_scale: Option<f64> = b"_ss" / b"Pss",
        /// Elem len, shaping type.
        element: Option<(f64, i32)> = b"_ha" / b"Sha",
        path: Option<PathControl> = b"Ntp",
        section: Option<Counted<f64>> = b"_ec" / b"Sec",
        colour: Option<Colour> = b"Scl",
    }

    /// The line of a path.
    PathControl until b"EOO" {
        points: Vec<PathPoint> = b"Pat",
        /// Line size, square size.
        line: Option<(i32, f64)> = b"_i2" / b"Si2",
        attributes: Option<i32> = b"At2",
        colour: Option<Colour> = b"Cl0",
        /// Position, max accel, nominal vel, target vel.
        motion: Option<[f64; 4]> = b"_m2" / b"Jm2",
        /// Angle coeff, length method.
        length: Option<(f64, i32)> = b"_v3" / b"Av3",
        on_spot_coeff: Option<f64> = b"_v9" / b"Av9",
        /// Avp r, avp v, avp a.
        averages: Option<[f64; 3]> = b"_v2" / b"Av2",
    }

    /// A control point of a path.
    PathPoint until b"EOO" {
        /// X, y, z, qw, qx, qy, qz, bez before, bez after, bez count, max rel vel.
        point: Option<(PositionFirst, [f64; 2], i32, f64)> = b"_t2" / b"At2",
        on_spot: Option<f64> = b"_t3" / b"At3",
        /// Aux flags, a0, a1, a2, a3.
        auxiliary: Option<(u16, [f64; 4])> = b"_t4" / b"At4",
    }
}
