//! Parts as scripts have them: a table of coordinates and a table of indices for each.

use mesh_files::{MeshFile, Part};

use scene::Data;

/// A table of coordinates for each part, and one of indices. None where tables could not hold them.
pub fn to_lists(file: &MeshFile) -> Option<(Data, Data)> {
    let numbers: usize = file
        .parts
        .iter()
        .map(|part| 3 * (part.vertices.len() + part.triangles.len()))
        .sum();
    if numbers > Data::MAX_ITEMS {
        return None;
    }
    let vertices = |part: &Part| {
        Data::Array(
            part.vertices
                .as_flattened()
                .iter()
                .map(|x| Data::Float(*x))
                .collect(),
        )
    };
    let indices = |part: &Part| {
        Data::Array(
            part.triangles
                .as_flattened()
                .iter()
                .map(|index| Data::Int(i64::from(*index)))
                .collect(),
        )
    };
    Some((
        Data::Array(file.parts.iter().map(vertices).collect()),
        Data::Array(file.parts.iter().map(indices).collect()),
    ))
}

/// Parts from tables of tables, or from two flat tables. None where they are no meshes.
pub fn to_parts(vertices: &Data, indices: &Data) -> Option<Vec<Part>> {
    let (Data::Array(vertices), Data::Array(indices)) = (vertices, indices) else {
        return None;
    };
    if vertices
        .first()
        .is_some_and(|first| first.as_f64().is_some())
    {
        return Some(vec![part(vertices, indices)?]);
    }
    if vertices.len() != indices.len() || vertices.is_empty() {
        return None;
    }
    let both = vertices.iter().zip(indices);
    both.map(|pair| {
        if let (Data::Array(vertices), Data::Array(indices)) = pair {
            part(vertices, indices)
        } else {
            None
        }
    })
    .collect()
}

fn part(vertices: &[Data], indices: &[Data]) -> Option<Part> {
    let coordinates: Vec<f64> = vertices.iter().map(Data::as_f64).collect::<Option<_>>()?;
    let corners: Vec<u32> = indices.iter().map(index).collect::<Option<_>>()?;
    let ((vertices, rest), (triangles, odd)) = (coordinates.as_chunks(), corners.as_chunks());
    let is_sound = rest.is_empty()
        && odd.is_empty()
        && corners
            .iter()
            .all(|corner| (*corner as usize) < vertices.len());
    is_sound.then(|| Part {
        vertices: vertices.to_vec(),
        triangles: triangles.to_vec(),
        ..Part::default()
    })
}

/// Whole numbers only; scripts compute indices as floats too.
fn index(data: &Data) -> Option<u32> {
    let number = data.as_f64()?;
    (number.fract() == 0.0 && (0.0..f64::from(u32::MAX)).contains(&number))
        .then_some(numbers::truncated_u32(number))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn array(numbers: &[f64]) -> Data {
        Data::Array(numbers.iter().map(|x| Data::Float(*x)).collect())
    }

    #[test]
    fn lists_come_back() {
        let (vertices, indices) = (
            array(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]),
            array(&[0.0, 1.0, 2.0]),
        );
        let flat = to_parts(&vertices, &indices).unwrap();
        let nested = to_parts(
            &Data::Array(vec![vertices.clone()]),
            &Data::Array(vec![indices]),
        )
        .unwrap();
        assert_eq!(flat, nested);
        let file = MeshFile {
            parts: flat,
            ..MeshFile::default()
        };
        let (again, triangles) = to_lists(&file).unwrap();
        assert_eq!(again, Data::Array(vec![vertices]));
        assert_eq!(
            triangles,
            Data::Array(vec![Data::Array(vec![
                Data::Int(0),
                Data::Int(1),
                Data::Int(2)
            ])])
        );
    }

    #[test]
    fn what_is_no_mesh_is_refused() {
        let vertices = array(&[0.0; 9]);
        let bad = [
            array(&[0.0, 1.0]),
            array(&[0.0, 1.0, 3.0]),
            array(&[0.0, 1.0, 1.5]),
            array(&[0.0, -1.0, 1.0]),
            Data::Nil,
        ];
        for indices in bad {
            assert!(to_parts(&vertices, &indices).is_none(), "{indices:?}");
        }
        assert!(to_parts(&array(&[0.0; 8]), &array(&[0.0, 0.0, 0.0])).is_none());
        assert!(to_parts(&Data::Array(vec![vertices]), &Data::Array(vec![])).is_none());
        assert!(to_parts(&Data::Array(vec![]), &Data::Array(vec![])).is_none());
    }
}
