//! Numbers that pages follow: read after every step, kept for a while, sent in batches.

use std::collections::VecDeque;
use std::sync::Arc;

use serde_json::{Map, Value, json};

use geometry::pose::pose_to_array;
use scene::{Data, Handle};
use simulator::Simulator;

/// Numbers that one page may follow.
const MAX_FOLLOWED: usize = 256;
/// Steps that are kept for pages that read slowly.
const MAX_STEPS: usize = 4096;
const MAX_NAME_LENGTH: usize = 200;
/// The pose in the world, which is no property.
pub(crate) const WORLD_POSE: &str = "absolutePose";

/// A number of a property.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Followed {
    pub handle: i64,
    pub name: String,
    /// Its place in a list, such as a vector.
    pub index: Option<usize>,
}

/// What a page follows; its messages have the key.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Following {
    pub key: i64,
    pub items: Vec<Followed>,
}

impl Following {
    /// # Errors
    /// What is wrong with the members of a request.
    pub(crate) fn read(members: &Map<String, Value>) -> Result<Self, String> {
        let key = members.get("key").and_then(Value::as_i64);
        let items = members.get("items").and_then(Value::as_array);
        let items = items.ok_or("`items` is a list")?;
        if items.len() > MAX_FOLLOWED {
            return Err(format!("`items` has at most {MAX_FOLLOWED} items"));
        }
        let items: Option<_> = items.iter().map(Followed::read).collect();
        Ok(Self {
            key: key.unwrap_or(0),
            items: items.ok_or("an item has a `handle`, a `name`, and an `index` or none")?,
        })
    }

    pub(crate) fn to_json(&self) -> Value {
        let items = self
            .items
            .iter()
            .map(|item| json!({ "handle": item.handle, "name": item.name, "index": item.index }));
        json!({ "do": "sample", "key": self.key, "items": items.collect::<Vec<_>>() })
    }
}

impl Followed {
    fn read(item: &Value) -> Option<Self> {
        let name = item["name"].as_str()?;
        let index = match &item["index"] {
            Value::Null => None,
            index => Some(usize::try_from(index.as_u64()?).ok()?),
        };
        (name.len() <= MAX_NAME_LENGTH).then(|| Self {
            handle: item["handle"].as_i64().unwrap_or(-1),
            name: name.to_owned(),
            index,
        })
    }

    /// The number now; NaN where there is none.
    fn number(&self, sim: &Simulator) -> f64 {
        if self.name == WORLD_POSE {
            return self.part_of_pose(sim).unwrap_or(f64::NAN);
        }
        let value = sim.property_value(self.handle, &self.name).ok();
        let part = match (value, self.index) {
            (Some(Data::Array(items)), Some(index)) => items.get(index).cloned(),
            (value, None) => value,
            _ => None,
        };
        match part {
            Some(Data::Float(value)) => value,
            Some(Data::Int(value)) => value as f64,
            Some(Data::Bool(value)) => f64::from(u8::from(value)),
            _ => f64::NAN,
        }
    }

    fn part_of_pose(&self, sim: &Simulator) -> Option<f64> {
        let pose = sim
            .scene()
            .world_pose(Handle::from_raw(self.handle)?)
            .ok()?;
        pose_to_array(&pose).get(self.index?).copied()
    }
}

/// The numbers of a step, in the order of what was followed.
struct Step {
    followed: Arc<[Followed]>,
    time: f64,
    numbers: Vec<f64>,
}

/// The last steps.
#[derive(Default)]
pub(crate) struct Samples {
    /// How many there were.
    taken: u64,
    steps: VecDeque<Step>,
}

impl Samples {
    /// How many steps there were.
    pub(crate) fn taken(&self) -> u64 {
        self.taken
    }

    /// Notes what is followed; sorted, so that it is found.
    pub(crate) fn take(&mut self, sim: &Simulator, followed: &Arc<[Followed]>) {
        let numbers = followed.iter().map(|item| item.number(sim)).collect();
        self.taken += 1;
        self.steps.push_back(Step {
            followed: Arc::clone(followed),
            time: sim.time(),
            numbers,
        });
        if self.steps.len() > MAX_STEPS {
            self.steps.pop_front();
        }
    }

    /// Notes the numbers once more where a person or a script has changed them without a step. Returns whether they are others.
    pub(crate) fn take_again(&mut self, sim: &Simulator) -> bool {
        let Some(last) = self.steps.back() else {
            return false;
        };
        let followed = Arc::clone(&last.followed);
        let differs =
            |(item, number): (&Followed, &f64)| item.number(sim).to_bits() != number.to_bits();
        let is_new = followed.iter().zip(&last.numbers).any(differs);
        if is_new {
            self.take(sim, &followed);
        }
        is_new
    }

    /// A message with the steps after the first `seen` ones, as far as they are kept; None without any.
    pub(crate) fn message(&self, following: &Following, seen: u64) -> Option<String> {
        let new = self.taken.saturating_sub(seen).min(self.steps.len() as u64) as usize;
        if new == 0 || following.items.is_empty() {
            return None;
        }
        let steps = || self.steps.range(self.steps.len() - new..);
        let column = |item: &Followed| -> Vec<f64> {
            let number = |step: &Step| Some(step.numbers[step.followed.binary_search(item).ok()?]);
            steps()
                .map(|step| number(step).unwrap_or(f64::NAN))
                .collect()
        };
        let times: Vec<f64> = steps().map(|step| step.time).collect();
        let columns: Vec<Vec<f64>> = following.items.iter().map(column).collect();
        // What is no number is null in JSON.
        Some(
            json!({ "type": "samples", "key": following.key, "times": times, "values": columns })
                .to_string(),
        )
    }

    pub(crate) fn forget(&mut self) {
        self.steps.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use simulator::Options;

    fn following(text: &str) -> Result<Following, String> {
        Following::read(
            serde_json::from_str::<Value>(text)
                .unwrap()
                .as_object()
                .unwrap(),
        )
    }

    #[test]
    fn numbers_of_each_step_in_the_order_of_the_page() {
        let mut sim = Simulator::new(Options::default());
        sim.scene_mut().add_default_objects().unwrap();
        let shape = sim
            .scene()
            .objects()
            .find(|object| object.shape().is_ok())
            .unwrap()
            .handle();
        let wanted = following(&format!(
            r#"{{"key": 7, "items": [{{"handle": {0}, "name": "absolutePose", "index": 6}}, {{"handle": -12, "name": "gravity", "index": 2}},
                {{"handle": {0}, "name": "respondable"}}, {{"handle": {0}, "name": "alias"}}, {{"handle": 999, "name": "mass"}}]}}"#,
            shape.raw()
        ))
        .unwrap();
        let mut items = wanted.items.clone();
        items.sort();
        let (mut samples, followed) = (Samples::default(), Arc::from(items));
        samples.take(&sim, &followed);
        sim.play();
        sim.iterate();
        sim.iterate();
        samples.take(&sim, &followed);
        let message: Value = serde_json::from_str(&samples.message(&wanted, 0).unwrap()).unwrap();
        assert_eq!(
            (&message["key"], message["times"].as_array().unwrap().len()),
            (&7.into(), 2)
        );
        assert!(message["times"][1].as_f64() > Some(0.0));
        assert_eq!(message["values"][0], json!([1.0, 1.0]));
        let gravity = message["values"][1][0].as_f64().unwrap();
        assert!((gravity + 9.81).abs() < 1e-6, "{gravity}");
        assert_eq!(message["values"][2][0], 1.0);
        assert_eq!(
            (&message["values"][3], &message["values"][4]),
            (&json!([null, null]), &json!([null, null]))
        );
        assert_eq!(samples.message(&wanted, 2), None);
        assert!(!samples.take_again(&sim));
        sim.call_api(
            "sim.setBoolProperty",
            &[
                Data::Int(shape.raw()),
                Data::text("respondable"),
                Data::Bool(false),
            ],
        )
        .unwrap();
        assert!(samples.take_again(&sim) && samples.message(&wanted, 2).is_some());
        let last: Value = serde_json::from_str(&samples.message(&wanted, 2).unwrap()).unwrap();
        assert_eq!(last["times"].as_array().unwrap().len(), 1);
    }

    #[test]
    fn what_is_kept_is_bounded() {
        let sim = Simulator::new(Options::default());
        let wanted = following(r#"{"items": [{"handle": -12, "name": "timeStep"}]}"#).unwrap();
        let mut samples = Samples::default();
        for _ in 0..MAX_STEPS + 10 {
            samples.take(&sim, &Arc::from(wanted.items.clone()));
        }
        let message: Value = serde_json::from_str(&samples.message(&wanted, 0).unwrap()).unwrap();
        assert_eq!(message["times"].as_array().unwrap().len(), MAX_STEPS);
    }

    #[test]
    fn what_is_no_list_of_numbers_is_refused() {
        let many = format!(
            r#"{{"items": [{}]}}"#,
            vec![r#"{"handle": 1, "name": "mass"}"#; MAX_FOLLOWED + 1].join(",")
        );
        for text in [
            "{}",
            r#"{"items": 5}"#,
            r#"{"items": [{"handle": 1}]}"#,
            r#"{"items": [{"handle": 1, "name": "mass", "index": -1}]}"#,
            &many,
        ] {
            assert!(
                following(text).is_err_and(|reason| !reason.is_empty()),
                "{text}"
            );
        }
    }
}
