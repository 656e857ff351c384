//! Octrees, point clouds, markers.

use super::Colour;
use crate::ttt::stream::streams;
use crate::ttt::value::{Counted, Rest};

streams! {
    /// An octree.
    OcTree until b"EOO" {
        /// Cell size, point size.
        sizes: Option<(f64, i32)> = b"_iz" / b"Siz",
        /// Bit1 show structure, bit2 random colours, bit3 points not cubes, bit4 always set, bit5 emissive.
        flags: Option<u8> = b"Var",
        colour: Option<Colour> = b"Col",
        /// Read only.
        points: Option<Counted<([f64; 3], [u8; 3])>> = b"_t2",
        /// Read only.
        old_points: Option<Counted<([f32; 3], [u8; 3])>> = b"Pt2",
        /// Read only.
        min_max: Option<[f32; 6]> = b"Mm2",
        /// Geometric plugin blob v1 (f32); read only.
        cells_v1: Option<Rest<u8>> = b"Co2",
        /// Plugin blob v2 (f64).
        cells_v2: Option<Rest<u8>> = b"_o2",
        /// Plugin blob v3.
        cells_v3: Option<Rest<u8>> = b"_o3",
    }

    /// A point cloud.
    PointCloud until b"EOO" {
        /// Cell size, point size.
        sizes: Option<(f64, i32)> = b"_iz" / b"Siz",
        removal_tol: Option<f64> = b"_ut" / b"Sut",
        insert_tol: Option<f64> = b"_dt" / b"adt",
        non_empty_cells: Option<i32> = b"Nec",
        display_ratio: Option<f64> = b"_dr" / b"Pdr",
        /// Max pts per cell, build res.
        cells: Option<(i32, f64)> = b"_cc" / b"Pcc",
        /// Bit1 show structure, bit2 random colours, bit3 always set, bit4 no octree, bit5 emissive.
        flags: Option<u8> = b"Var",
        colour: Option<Colour> = b"Col",
        /// Development version after 4.10.
        alpha: Option<Counted<u8>> = b"_a2",
        points: Option<Counted<([f64; 3], [u8; 3])>> = b"_t2" / b"Pt2",
        /// Read only.
        min_max: Option<[f32; 6]> = b"Mmd",
        /// Read only.
        cells_v1: Option<Rest<u8>> = b"Co2",
        cells_v2: Option<Rest<u8>> = b"_o2",
        cells_v3: Option<Rest<u8>> = b"_o3",
    }

    /// A marker (after 4.10).
    Marker until b"EOO" {
        flags: Option<u8> = b"Var",
        /// Item type, max cnt, options, dup tol, r, g, b, a, sx, sy, sz.
        settings: Option<([i32; 3], f32, [u8; 4], [f64; 3])> = b"Set",
        /// X0, x1, y0, y1, z0, z1.
        extent: Option<[f64; 6]> = b"Ext",
        pts: Option<Counted<f32>> = b"Pts",
        quats: Option<Counted<f32>> = b"Qts",
        rgba: Option<Counted<u8>> = b"Cls",
        sizes: Option<Counted<f32>> = b"Siz",
        vertices: Option<Counted<f32>> = b"Ver",
        indices: Option<Counted<i32>> = b"Ind",
        normals: Option<Counted<f32>> = b"Nor",
    }
}
