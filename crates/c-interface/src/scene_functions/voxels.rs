//! Octrees and point clouds: three numbers for each point, and their count.

use scene::{Data, numbers};

use super::pointers::numbers_of;
use crate::dispatch::{Call, integer};
use crate::functions::{Answer, Function};

/// Option of insertions: there is a colour for each point.
const COLOUR_PER_POINT: i64 = 2;

/// The functions by their names in the table of symbols.
pub(super) const FUNCTIONS: &[(&str, Function)] = &[
    ("octree.insert", insert_voxels),
    ("octree.remove", |call| {
        points(call, "sim.removeVoxelsFromOctree", &[])
    }),
    ("octree.voxels", |call| {
        contents(call, "sim.getOctreeVoxels")
    }),
    ("octree.insert_object", insert_object_into_octree),
    ("octree.occupancy", occupancy),
    ("cloud.insert", insert_points),
    ("cloud.remove", |call| {
        points(call, "sim.removePointsFromPointCloud", &[tolerance(call)])
    }),
    ("cloud.intersect", |call| {
        points(
            call,
            "sim.intersectPointsWithPointCloud",
            &[tolerance(call)],
        )
    }),
    ("cloud.points", |call| {
        contents(call, "sim.getPointCloudPoints")
    }),
    ("cloud.insert_object", insert_object_into_cloud),
];

fn tolerance(call: &Call<'_>) -> Data {
    Data::Float(call.number_at(4))
}

/// Parameters: object, options, points or NULL for all, their count; what else scripts pass.
fn points(call: &Call<'_>, function: &str, more: &[Data]) -> Answer {
    let mut args = vec![Data::Int(call.integer_at(0)), Data::Int(call.integer_at(1))];
    args.push(call.optional_numbers_at(2, call.count_at(3)?.saturating_mul(3))?);
    args.extend_from_slice(more);
    call.frame.host().call(function, &args)
}

/// Coordinates, and how many points they are.
fn contents(call: &Call<'_>, function: &str) -> Answer {
    let args = [Data::Int(call.integer_at(0))];
    let mut results = call.frame.host().call(function, &args)?;
    let coordinates = results.first().map_or(0, |list| numbers_of(list).len());
    results.truncate(1);
    results.push(Data::Int(numbers::count(coordinates / 3)));
    Ok(results)
}

/// Red, green, blue of all points or of each; nil for NULL.
fn colours(call: &Call<'_>, place: usize, points: usize) -> Result<Data, String> {
    let colours: Option<Vec<u8>> = call.optional_at(place, points.saturating_mul(3))?;
    Ok(colours.map_or(Data::Nil, |colours| {
        colours
            .into_iter()
            .map(i64::from)
            .collect::<Vec<_>>()
            .into()
    }))
}

/// For how many points there are colours.
fn coloured(call: &Call<'_>, points: usize) -> usize {
    if call.integer_at(1) & COLOUR_PER_POINT == 0 {
        1
    } else {
        points
    }
}

/// Parameters: octree, options, points, their count, colours, tags.
fn insert_voxels(call: &Call<'_>) -> Answer {
    let count = call.count_at(3)?;
    let coloured = coloured(call, count);
    let tags: Option<Vec<i32>> = call.optional_at(5, coloured)?;
    let tags = tags.map_or(Data::Nil, |tags| {
        let mut tags = tags.into_iter().map(|tag| i64::from(tag.cast_unsigned()));
        match call.integer_at(1) & COLOUR_PER_POINT {
            0 => tags.next().map_or(Data::Nil, Data::Int),
            _ => tags.collect::<Vec<_>>().into(),
        }
    });
    let more = [colours(call, 4, coloured)?, tags];
    points(call, "sim.insertVoxelsIntoOctree", &more)
}

/// Parameters: octree, object, options, colour, tag.
fn insert_object_into_octree(call: &Call<'_>) -> Answer {
    let args = [
        Data::Int(call.integer_at(0)),
        Data::Int(call.integer_at(1)),
        Data::Int(call.integer_at(2)),
        colours(call, 3, 1)?,
        Data::Int(call.integer_at(4)),
    ];
    call.frame.host().call("sim.insertObjectIntoOctree", &args)
}

/// Whether all points are in voxels; tag and place of the voxel of a single one.
fn occupancy(call: &Call<'_>) -> Answer {
    let mut results = points(call, "sim.checkOctreePointOccupancy", &[])?;
    if let [_, _, low, high] = &results[..] {
        let place = integer(low) | integer(high) << 32;
        results.truncate(2);
        results.push(Data::Int(place));
    }
    Ok(results)
}

/// Parameters: point cloud, options, points, their count, colours, optional values.
fn insert_points(call: &Call<'_>) -> Answer {
    refuse_optional_values(call, 5)?;
    let coloured = coloured(call, call.count_at(3)?);
    let more = [colours(call, 4, coloured)?];
    points(call, "sim.insertPointsIntoPointCloud", &more)
}

/// Parameters: point cloud, object, options, size of the grid, colour, optional values.
fn insert_object_into_cloud(call: &Call<'_>) -> Answer {
    refuse_optional_values(call, 5)?;
    let args = [
        Data::Int(call.integer_at(0)),
        Data::Int(call.integer_at(1)),
        Data::Int(call.integer_at(2)),
        Data::Float(call.number_at(3)),
        colours(call, 4, 1)?,
    ];
    call.frame
        .host()
        .call("sim.insertObjectIntoPointCloud", &args)
}

fn refuse_optional_values(call: &Call<'_>, place: usize) -> Result<(), String> {
    match call.values.get(place) {
        Some(value) if !value.address.is_null() => {
            Err("optional values are not implemented in Swanilda: pass NULL".into())
        }
        _ => Ok(()),
    }
}
