//! The parameters of a scriptable function, as its row describes them.

use super::args::{Absence, FromScript};
use super::literal::literal;
use scene::Data;

/// One parameter of a scriptable function.
#[derive(Debug)]
pub struct Param {
    /// `...` for the one that takes all further arguments.
    pub name: &'static str,
    /// The type, as the reference shows it: `int`, `float[3]`.
    pub ty: &'static str,
    /// What a call without the argument means; None when there is nothing a script could write instead.
    pub default: Option<DefaultValue>,
    is_required: bool,
}

/// The default of a parameter.
#[derive(Debug, Clone, Copy)]
pub struct DefaultValue {
    /// Makes the default value.
    pub value: fn() -> Data,
    /// The constant that has this value, where a script would write that: `sim.handle_world`.
    pub constant: Option<&'static str>,
}

impl DefaultValue {
    /// The constant, or the value as a script would write it.
    pub fn text(self) -> String {
        self.constant
            .map_or_else(|| literal(&(self.value)()), str::to_owned)
    }
}

impl Param {
    /// A parameter without a default of its own.
    ///
    /// # Panics
    /// When exactly one of name and type is that of all further arguments.
    pub const fn new<T: FromScript>(name: &'static str) -> Self {
        let default = match T::ABSENCE {
            Absence::Nil => Some(DefaultValue {
                value: || Data::Nil,
                constant: None,
            }),
            Absence::Refused | Absence::Decoded => None,
        };
        let is_required = matches!(T::ABSENCE, Absence::Refused);
        Self {
            default,
            is_required,
            ..Self::required(name, T::TYPE)
        }
    }

    /// A parameter with a default.
    ///
    /// # Panics
    /// As [`Param::new`].
    pub const fn optional<T: FromScript>(name: &'static str, default: DefaultValue) -> Self {
        Self {
            default: Some(default),
            is_required: false,
            ..Self::required(name, T::TYPE)
        }
    }

    /// A parameter of a function that decodes its arguments itself.
    ///
    /// # Panics
    /// As [`Param::new`].
    pub const fn required(name: &'static str, ty: &'static str) -> Self {
        assert!(
            takes_all(name) == takes_all(ty),
            "the parameter that takes all further arguments, and no other one, is named `...`: #[name(\"...\")]"
        );
        Self {
            name,
            ty,
            default: None,
            is_required: true,
        }
    }

    /// How many arguments a call needs.
    pub const fn count_required(params: &[Self]) -> usize {
        let mut count = params.len();
        while count > 0 && !params[count - 1].is_required {
            count -= 1;
        }
        count
    }
}

const fn takes_all(word: &str) -> bool {
    matches!(word.as_bytes(), [.., b'.', b'.', b'.'])
}

#[cfg(test)]
mod tests {
    use super::{DefaultValue, Param};
    use crate::Rest;
    use scene::Data;

    #[test]
    fn arguments_are_required_up_to_the_last_one_without_which_a_call_fails() {
        const ZERO: DefaultValue = DefaultValue {
            value: || Data::Int(0),
            constant: None,
        };
        let first = || Param::new::<i64>("first");
        let optional = || Param::optional::<i64>("second", ZERO);
        let nil = || Param::new::<Option<i64>>("third");
        let rest = || Param::new::<Rest>("...");
        assert_eq!(Param::count_required(&[]), 0);
        assert_eq!(Param::count_required(&[optional(), nil(), rest()]), 0);
        assert_eq!(Param::count_required(&[first(), optional(), nil()]), 1);
        assert_eq!(Param::count_required(&[optional(), first(), rest()]), 2);
    }

    #[test]
    fn what_a_type_takes_for_absent_is_its_default() {
        let default = |param: Param| param.default.map(|default| (default.value)());
        assert_eq!(default(Param::new::<Option<i64>>("a")), Some(Data::Nil));
        assert_eq!(default(Param::new::<i64>("a")), None);
        assert_eq!(default(Param::new::<Rest>("...")), None);
    }

    #[test]
    #[should_panic(expected = "is named `...`")]
    fn all_further_arguments_have_no_other_name() {
        let _ = Param::new::<Rest>("values");
    }
}
