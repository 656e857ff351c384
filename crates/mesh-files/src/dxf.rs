//! AutoCAD drawing exchange, text form: `3DFACE`, and `POLYLINE` with polyface or polygon meshes, a part for each layer.
//!
//! Curves, solids (`3DSOLID`, which only AutoCAD's modeller reads) and blocks are left out; a file of nothing else is refused with their names.

use std::collections::BTreeMap;

use crate::corners::{Corner, Lists, NONE, part, push_polygon};
use crate::error::{Location, ReadError, Result};
use crate::limits::Limits;
use crate::mesh_file::{Material, MeshFile};
use crate::text::{name, number, quoted};

/// One group: a code and its value.
#[derive(Clone, Copy)]
struct Group<'a> {
    code: i32,
    value: &'a [u8],
    place: Location,
}

#[derive(Default)]
struct Layer {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[Corner; 3]>,
}

/// What a POLYLINE collects until its SEQEND.
#[derive(Default)]
struct Polyline {
    layer: String,
    flags: i64,
    /// Of a polygon mesh: rows and columns.
    size: [usize; 2],
    points: Vec<[f64; 3]>,
    /// Of a polyface mesh: vertices of the faces, from 1.
    faces: Vec<Vec<usize>>,
    place: Option<Location>,
}

#[derive(Default)]
struct Reader {
    layers: BTreeMap<String, Layer>,
    polyline: Option<Polyline>,
    others: BTreeMap<String, usize>,
}

pub(crate) fn read(bytes: &[u8], mut limits: Limits) -> Result<MeshFile> {
    if bytes.starts_with(b"AutoCAD Binary DXF") {
        return Err(ReadError::new(
            Location::Byte(0),
            "file",
            "a binary DXF; only its text form is read",
        ));
    }
    let mut reader = Reader::default();
    for entity in entities(bytes)? {
        reader.entity(&entity)?;
    }
    if reader
        .layers
        .values()
        .all(|layer| layer.triangles.is_empty())
    {
        return Err(reader.nothing());
    }
    let mut file = MeshFile::default();
    for (name, layer) in &reader.layers {
        let lists = Lists {
            positions: &layer.positions,
            ..Lists::default()
        };
        let part = part(name.clone(), lists, &layer.triangles, Material::default());
        limits.take(part.vertices.len(), part.triangles.len())?;
        file.parts.push(part);
    }
    Ok(file)
}

/// The groups of each entity of the ENTITIES section.
fn entities(bytes: &[u8]) -> Result<Vec<Vec<Group<'_>>>> {
    let mut lines = bytes
        .split(|&byte| byte == b'\n')
        .map(<[u8]>::trim_ascii)
        .zip(1..);
    let (mut entities, mut is_inside, mut is_section): (Vec<Vec<Group>>, _, _) =
        (Vec::new(), false, false);
    while let Some((code, line)) = lines.next() {
        let place = Location::Line(line);
        let Some((value, _)) = lines.next() else {
            break;
        };
        let code = std::str::from_utf8(code)
            .ok()
            .and_then(|code| code.parse().ok());
        let code =
            code.ok_or_else(|| ReadError::new(place, "group", "the code is not a number"))?;
        match (code, value) {
            (0, b"EOF") => return Ok(entities),
            (0, b"ENDSEC") => is_inside = false,
            (0, b"SECTION") => is_section = true,
            (2, name) if is_section => (is_section, is_inside) = (false, name == b"ENTITIES"),
            (0, _) if is_inside => entities.push(vec![Group { code, value, place }]),
            (_, _) if is_inside => entities.extend_last(Group { code, value, place }),
            _ => {}
        }
    }
    Err(ReadError::new(
        Location::File,
        "file",
        "it ends before `EOF`",
    ))
}

trait ExtendLast<'a> {
    /// Adds a group to the last entity, if there is one.
    fn extend_last(&mut self, group: Group<'a>);
}

impl<'a> ExtendLast<'a> for Vec<Vec<Group<'a>>> {
    fn extend_last(&mut self, group: Group<'a>) {
        if let Some(last) = self.last_mut() {
            last.push(group);
        }
    }
}

fn value<'a, 'b>(entity: &'b [Group<'a>], code: i32) -> Option<&'b Group<'a>> {
    entity.iter().find(|group| group.code == code)
}

/// A coordinate; 0 if it is not there.
fn coordinate(entity: &[Group], code: i32) -> Result<f64> {
    let Some(group) = value(entity, code) else {
        return Ok(0.0);
    };
    number(group.value).ok_or_else(|| {
        ReadError::new(
            group.place,
            "coordinate",
            format!("not a finite number: {}", quoted(group.value)),
        )
    })
}

fn point(entity: &[Group], first: i32) -> Result<[f64; 3]> {
    Ok([
        coordinate(entity, first)?,
        coordinate(entity, first + 10)?,
        coordinate(entity, first + 20)?,
    ])
}

fn integer(entity: &[Group], code: i32) -> i64 {
    value(entity, code)
        .and_then(|group| std::str::from_utf8(group.value).ok()?.parse().ok())
        .unwrap_or(0)
}

fn layer(entity: &[Group]) -> String {
    value(entity, 8).map_or_else(String::new, |group| name(group.value))
}

impl Reader {
    fn entity(&mut self, entity: &[Group]) -> Result<()> {
        match entity[0].value {
            b"3DFACE" => self.face(entity)?,
            b"POLYLINE" => self.polyline = Some(Polyline::begin(entity)),
            b"VERTEX" => self
                .polyline
                .as_mut()
                .map_or(Ok(()), |polyline| polyline.vertex(entity))?,
            b"SEQEND" => self.end_polyline()?,
            other => {
                *self
                    .others
                    .entry(name(&other[..other.len().min(40)]))
                    .or_default() += 1;
            }
        }
        Ok(())
    }

    /// Three or four corners; the fourth may be the third again.
    fn face(&mut self, entity: &[Group]) -> Result<()> {
        let mut corners = [10, 11, 12, 13]
            .map(|first| point(entity, first))
            .into_iter()
            .collect::<Result<Vec<_>>>()?;
        if value(entity, 13).is_none() || corners[3] == corners[2] {
            corners.pop();
        }
        self.layers
            .entry(layer(entity))
            .or_default()
            .polygon(&corners);
        Ok(())
    }

    fn end_polyline(&mut self) -> Result<()> {
        let Some(polyline) = self.polyline.take() else {
            return Ok(());
        };
        if polyline.flags & 64 != 0 {
            polyline.polyface(self.layers.entry(polyline.layer.clone()).or_default())
        } else if polyline.flags & 16 != 0 {
            polyline.grid(self.layers.entry(polyline.layer.clone()).or_default())
        } else {
            *self
                .others
                .entry("POLYLINE without a mesh".into())
                .or_default() += 1;
            Ok(())
        }
    }

    fn nothing(&self) -> ReadError {
        let others: Vec<String> = self
            .others
            .iter()
            .take(10)
            .map(|(name, count)| format!("{count} {name}"))
            .collect();
        let problem = format!("no 3DFACE and no POLYLINE mesh, but: {}", others.join(", "));
        ReadError::new(
            Location::File,
            "file",
            if others.is_empty() {
                "no triangles".into()
            } else {
                problem
            },
        )
    }
}

impl Layer {
    fn polygon(&mut self, points: &[[f64; 3]]) {
        let first = numbers::count_u32(self.positions.len());
        self.positions.extend_from_slice(points);
        let corners: Vec<Corner> = (0..numbers::count_u32(points.len()))
            .map(|corner| Corner {
                position: first + corner,
                normal: NONE,
                uv: NONE,
            })
            .collect();
        push_polygon(&corners, &self.positions, &mut self.triangles);
    }
}

impl Polyline {
    fn begin(entity: &[Group]) -> Self {
        let size = [71, 72].map(|code| usize::try_from(integer(entity, code)).unwrap_or(0));
        Self {
            layer: layer(entity),
            flags: integer(entity, 70),
            size,
            place: Some(entity[0].place),
            ..Self::default()
        }
    }

    /// A point, or a face of a polyface mesh: indices that are negative where the edge is invisible.
    fn vertex(&mut self, entity: &[Group]) -> Result<()> {
        let flags = integer(entity, 70);
        if self.flags & 64 != 0 && flags & 128 != 0 && flags & 64 == 0 {
            let indices = [71, 72, 73, 74].map(|code| {
                usize::try_from(integer(entity, code).unsigned_abs()).unwrap_or(usize::MAX)
            });
            self.faces
                .push(indices.into_iter().filter(|index| *index > 0).collect());
        } else {
            self.points.push(point(entity, 10)?);
        }
        Ok(())
    }

    fn polyface(&self, layer: &mut Layer) -> Result<()> {
        for face in &self.faces {
            let points: Option<Vec<_>> = face
                .iter()
                .map(|index| self.points.get(index - 1).copied())
                .collect();
            let points =
                points.ok_or_else(|| self.refused("a face names a vertex that is not there"))?;
            if points.len() >= 3 {
                layer.polygon(&points);
            }
        }
        Ok(())
    }

    /// Flag 1: closed along the rows, 32: along the columns.
    fn grid(&self, layer: &mut Layer) -> Result<()> {
        let [rows, columns] = self.size;
        if rows.checked_mul(columns) != Some(self.points.len()) {
            return Err(self.refused("a polygon mesh whose size is not the number of its vertices"));
        }
        let point =
            |row: usize, column: usize| self.points[row % rows * columns + column % columns];
        for row in 0..if self.flags & 1 != 0 {
            rows
        } else {
            rows.saturating_sub(1)
        } {
            for column in 0..if self.flags & 32 != 0 {
                columns
            } else {
                columns.saturating_sub(1)
            } {
                let (below, right) = (row + 1, column + 1);
                layer.polygon(&[
                    point(row, column),
                    point(below, column),
                    point(below, right),
                    point(row, right),
                ]);
            }
        }
        Ok(())
    }

    fn refused(&self, problem: &str) -> ReadError {
        ReadError::new(self.place.unwrap_or(Location::File), "POLYLINE", problem)
    }
}
