//! Recording of graph streams, their transformations and curves.

use super::{Graph, GraphCurve, GraphSample, GraphStream, Transformation, TransformationKind};

impl Graph {
    /// Records the next values of the streams; a stream without one gets a gap. A full graph that is not cyclic records nothing.
    pub fn record(&mut self, time: f64) {
        let most = usize::try_from(self.buffer_size).unwrap_or(0).max(1);
        if self.times.len() >= most && !self.cyclic {
            return;
        }
        let step = self.times.back().map(|last| time - last);
        for stream in self
            .streams
            .iter_mut()
            .filter(|stream| stream.fixed.is_none())
        {
            let raw = stream.next.take();
            let sample = GraphSample {
                raw,
                transformed: stream
                    .transformation
                    .apply(raw, stream.samples.back(), step),
            };
            stream.samples.push_back(sample);
        }
        self.times.push_back(time);
        let surplus = self.times.len().saturating_sub(most);
        self.times.drain(..surplus);
        for stream in &mut self.streams {
            let surplus = stream.samples.len().saturating_sub(self.times.len());
            stream.samples.drain(..surplus);
        }
    }

    /// Clears the recorded data. What is fixed stays.
    pub fn reset(&mut self) {
        self.times.clear();
        for stream in &mut self.streams {
            stream.samples.clear();
            stream.next = None;
        }
    }

    /// Times and values of a stream, gaps left out.
    pub fn values(&self, stream: &GraphStream) -> Vec<[f64; 2]> {
        match &stream.fixed {
            Some(fixed) => fixed.clone(),
            None => self
                .times
                .iter()
                .zip(stream.slots(self.times.len()))
                .filter_map(|(time, value)| Some([*time, value?]))
                .collect(),
        }
    }

    /// The points of a curve; slots in which a stream has a gap are left out.
    pub fn points(&self, curve: &GraphCurve) -> Vec<[f64; 3]> {
        if let Some(fixed) = &curve.fixed {
            return fixed.clone();
        }
        let slots = [0, 1, 2].map(|axis| {
            let id = curve.streams[axis];
            let stream = self
                .streams
                .iter()
                .find(|stream| stream.style.id == id && axis < curve.dimensions);
            stream.map(|stream| stream.slots(self.times.len()))
        });
        let coordinate = |slot: usize, axis: usize| match &slots[axis] {
            Some(values) => values.get(slot).copied().flatten(),
            None => Some(curve.defaults[axis]),
        };
        let point = |slot| {
            Some([
                coordinate(slot, 0)?,
                coordinate(slot, 1)?,
                coordinate(slot, 2)?,
            ])
        };
        (0..self.times.len()).filter_map(point).collect()
    }
}

impl GraphStream {
    /// The value of each of the slots of a graph: multiplied, moved, and averaged.
    fn slots(&self, all: usize) -> Vec<Option<f64>> {
        let Transformation {
            multiplier,
            offset,
            period,
            ..
        } = self.transformation;
        let scaled = |sample: &GraphSample| {
            Some(multiplier * sample.transformed? + offset).filter(|value| value.is_finite())
        };
        let before = std::iter::repeat_n(None, all.saturating_sub(self.samples.len()));
        let scaled: Vec<Option<f64>> = before.chain(self.samples.iter().map(scaled)).collect();
        match usize::try_from(period) {
            Ok(period) if period > 1 => averaged(&scaled, period),
            _ => scaled,
        }
    }
}

/// The mean of the last `period` slots, gaps left out; nothing where the newest is a gap or there are fewer slots.
fn averaged(values: &[Option<f64>], period: usize) -> Vec<Option<f64>> {
    let (mut sum, mut count) = (0.0, 0u32);
    let mean = |(slot, newest): (usize, &Option<f64>)| {
        if let Some(value) = newest {
            (sum, count) = (sum + value, count + 1);
        }
        if let Some(Some(oldest)) = slot.checked_sub(period).map(|gone| values[gone]) {
            (sum, count) = (sum - oldest, count - 1);
        }
        newest
            .filter(|_| slot + 1 >= period)
            .map(|_| sum / f64::from(count))
    };
    values.iter().enumerate().map(mean).collect()
}

impl Transformation {
    /// Transformed value; `before` is the previous sample, `step` seconds ago.
    fn apply(
        &self,
        raw: Option<f64>,
        before: Option<&GraphSample>,
        step: Option<f64>,
    ) -> Option<f64> {
        use TransformationKind::{Cumulative, Derivative, Integral, Raw};
        let raw = raw?;
        let before = before.and_then(|sample| Some((sample.raw?, sample.transformed, step?)));
        match (self.kind, before) {
            (Raw, _) => Some(raw),
            (Derivative, None) => None,
            (Derivative, Some((last, _, step))) => {
                (step > 0.0).then(|| self.difference(last, raw) / step)
            }
            (Integral, Some((last, Some(sum), step))) => {
                Some(sum + step * (last + 0.5 * self.difference(last, raw)))
            }
            (Integral, _) => Some(0.0),
            (Cumulative, Some((last, Some(sum), _))) => {
                Some(sum + last + self.difference(last, raw))
            }
            (Cumulative, _) => Some(raw),
        }
    }

    /// From one value to the next, the shortest way where values are cyclic.
    fn difference(&self, last: f64, raw: f64) -> f64 {
        let difference = raw - last;
        let range = self.cyclic_range;
        if range > 0.0 {
            difference - range * (difference / range).round()
        } else {
            difference
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::CurveStyle;

    fn style(name: &str) -> CurveStyle {
        let name = name.to_owned();
        CurveStyle {
            id: 0,
            name,
            unit: String::new(),
            colour: [1.0; 3],
            label: true,
            linked: true,
        }
    }

    /// The values of a stream into which these are recorded, one each 0.05 s.
    fn recorded(transformation: Transformation, values: &[Option<f64>]) -> Vec<Option<f64>> {
        let mut graph = Graph::default();
        let id = graph
            .add_stream(GraphStream {
                transformation,
                ..GraphStream::new(style("s"))
            })
            .unwrap();
        for (slot, value) in values.iter().enumerate() {
            graph.stream_mut(id).unwrap().next = *value;
            graph.record(0.05 * slot as f64);
        }
        graph.streams()[0].slots(values.len())
    }

    #[track_caller]
    fn assert_near(found: &[Option<f64>], expected: &[Option<f64>]) {
        let near = |(a, b): (&Option<f64>, &Option<f64>)| match (a, b) {
            (Some(a), Some(b)) => (a - b).abs() < 1e-9,
            (a, b) => a == b,
        };
        assert!(
            found.len() == expected.len() && found.iter().zip(expected).all(near),
            "{found:?}"
        );
    }

    #[test]
    fn transformations_are_those_of_the_specification() {
        let values = [Some(0.0), Some(1.0), Some(3.0)];
        let kind = |kind| Transformation {
            kind,
            ..Transformation::default()
        };
        assert_near(
            &recorded(kind(TransformationKind::Derivative), &values),
            &[None, Some(20.0), Some(40.0)],
        );
        assert_near(
            &recorded(kind(TransformationKind::Integral), &values),
            &[Some(0.0), Some(0.025), Some(0.125)],
        );
        assert_near(
            &recorded(kind(TransformationKind::Cumulative), &values),
            &[Some(0.0), Some(1.0), Some(4.0)],
        );
        let cyclic = Transformation {
            cyclic_range: 6.0,
            ..kind(TransformationKind::Derivative)
        };
        assert_near(
            &recorded(cyclic, &[Some(5.5), Some(0.5)]),
            &[None, Some(20.0)],
        );
    }

    #[test]
    fn gaps_begin_anew() {
        let values = [Some(1.0), None, Some(3.0)];
        let kind = |kind| Transformation {
            kind,
            ..Transformation::default()
        };
        assert_near(
            &recorded(kind(TransformationKind::Derivative), &values),
            &[None, None, None],
        );
        assert_near(
            &recorded(kind(TransformationKind::Integral), &values),
            &[Some(0.0), None, Some(0.0)],
        );
        assert_near(
            &recorded(kind(TransformationKind::Cumulative), &values),
            &[Some(1.0), None, Some(3.0)],
        );
    }

    #[test]
    fn averages_need_all_their_slots() {
        let transformation = Transformation {
            multiplier: 2.0,
            offset: 1.0,
            period: 2,
            ..Transformation::default()
        };
        let values = [Some(1.0), Some(3.0), None, Some(5.0)];
        assert_near(
            &recorded(transformation, &values),
            &[None, Some(5.0), None, Some(11.0)],
        );
    }

    #[test]
    fn slots_before_a_stream_are_gaps() {
        let mut graph = Graph::default();
        (0..3).for_each(|time| graph.record(f64::from(time)));
        let id = graph.add_stream(GraphStream::new(style("late"))).unwrap();
        graph.stream_mut(id).unwrap().next = Some(7.0);
        graph.record(3.0);
        assert_eq!(graph.values(&graph.streams()[0]), [[3.0, 7.0]]);
    }

    #[test]
    fn the_oldest_slots_go_first() {
        let mut graph = Graph {
            buffer_size: 2,
            ..Graph::default()
        };
        let (a, b) = (
            graph.add_stream(GraphStream::new(style("a"))).unwrap(),
            graph.add_stream(GraphStream::new(style("b"))).unwrap(),
        );
        for slot in 0..3 {
            graph.stream_mut(a).unwrap().next = Some(f64::from(slot));
            graph.stream_mut(b).unwrap().next = Some(f64::from(-slot)).filter(|_| slot != 1);
            graph.record(f64::from(slot));
        }
        let curve = GraphCurve {
            style: style("c"),
            width: 1,
            dimensions: 2,
            streams: [a, b, -1],
            defaults: [0.0, 0.0, 7.0],
            relative: true,
            fixed: None,
            old: false,
        };
        assert_eq!(graph.values(&graph.streams()[0]), [[1.0, 1.0], [2.0, 2.0]]);
        let id = graph.add_curve(curve).unwrap();
        assert_eq!(graph.points(&graph.curves[0]), [[2.0, -2.0, 7.0]]);
        let fixed = graph.fix_curve(id, "").unwrap();
        graph.reset();
        assert_eq!(graph.points(&graph.curves[1]), [[2.0, -2.0, 7.0]]);
        assert!(graph.remove_curve(fixed).is_ok() && graph.remove_curve(fixed).is_err());
        graph.cyclic = false;
        (0..5).for_each(|time| graph.record(f64::from(time)));
        assert_eq!(graph.times().collect::<Vec<_>>(), [0.0, 1.0]);
    }
}
