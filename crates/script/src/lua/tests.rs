//! Tests of the edge to Lua as a whole.

use std::marker::PhantomData;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::rc::Rc;

use super::{Owner, Stack, State, push_callback};
use permissions::Permissions;

/// Calls `test` with a state that has the standard libraries only.
pub(super) fn with_state<T>(test: impl FnOnce(&State) -> T) -> T {
    let owner = Owner::new(Rc::new(7), Rc::default(), Permissions::all(), false);
    test(&State::new(owner))
}

#[test]
fn the_host_is_what_the_state_was_made_with() {
    with_state(|state| {
        assert_eq!(*state.stack().host::<i32>(), 7);
        let other = catch_unwind(AssertUnwindSafe(|| *state.stack().host::<u32>()));
        assert!(other.is_err());
    });
}

#[test]
fn random_numbers_begin_where_lua_says() {
    with_state(|state| {
        for seed in [0, 1, -1, 42, i64::MAX, 0x1234_5678_9abc_def0] {
            let code = format!("math.randomseed({seed})");
            state.lua().load(code).exec().expect("runs");
            assert_eq!(state.random_state(), Some(super::seeded(seed)));
        }
    });
}

#[test]
fn entries_end_when_the_table_loses_the_current_key() {
    with_state(|state| {
        let stack = state.stack();
        stack.new_table(0, 0);
        for i in 1..=3 {
            stack.push_int(i);
            stack.raw_set_field(1, &i.to_string());
        }
        let mut entries = stack.entries(1);
        assert!(entries.advance());
        stack.push_value(entries.key());
        stack.push_nil();
        stack.raw_set(1);
        // New fields move the others, and the removed key is forgotten: Lua would raise.
        for i in 10..100 {
            stack.push_int(i);
            stack.raw_set_index(1, i);
        }
        assert!(!entries.advance());
        assert_eq!(stack.top(), 1);
    });
}

#[test]
fn entries_are_all_there_whatever_is_left_on_the_stack() {
    with_state(|state| {
        let stack = state.stack();
        stack.push_numbers(&[1.5, 2.5, 3.5]);
        let (mut entries, mut sum) = (stack.entries(1), 0.0);
        while entries.advance() {
            sum += [entries.key(), entries.value()]
                .map(|at| stack.number(at).unwrap_or_default())
                .iter()
                .sum::<f64>();
            stack.push_bytes(b"more");
        }
        assert_eq!((sum, stack.top()), (13.5, 1));
    });
}

#[test]
fn a_mistake_of_ours_is_a_panic() {
    with_state(|state| {
        let stack = state.stack();
        let panics = |mistake: &dyn Fn(Stack<'_>)| {
            catch_unwind(AssertUnwindSafe(|| mistake(stack))).is_err()
        };
        stack.push_int(1);
        let with_one_value: [&dyn Fn(Stack<'_>); 8] = [
            &|stack| stack.pop(2),
            &|stack| stack.set_top(2),
            &|stack| stack.insert(5),
            &|stack| stack.push_value(3),
            &|stack| stack.raw_set(1),
            &|stack| assert_ne!(stack.raw_get(1), super::Type::None),
            &|stack| stack.set_metatable(1),
            &|stack| assert!(stack.protected_call(1, 0).is_ok()),
        ];
        assert!(with_one_value.iter().all(|mistake| panics(mistake)));
        stack.pop(1);
        assert!(panics(&|stack| stack.set_registry(c"none")));
        assert!(panics(
            &|stack| stack.release_function(stack.keep_function())
        ));
        assert_eq!(stack.top(), 0);
    });
}

#[test]
fn a_panic_of_a_callback_is_an_error_that_scripts_can_catch() {
    with_state(|state| {
        let broken = |_: Stack<'_>, number| {
            if number == 7 {
                panic!("out of order")
            } else {
                Ok(0)
            }
        };
        push_callback(state.stack(), broken, 7);
        state.stack().set_global("broken");
        let text: String = state
            .lua()
            .load("return select(2, pcall(broken, 1, 2))")
            .eval()
            .expect("runs");
        assert!(text.ends_with("out of order"), "{text}");
    });
}

/// `Stack::with_bytes` relies on it.
#[test]
fn nothing_that_leads_to_a_state_can_be_sent() {
    struct Check<T>(PhantomData<T>);
    trait Otherwise {
        const IS_SEND: bool = false;
    }
    impl<T> Otherwise for Check<T> {}
    impl<T: Send> Check<T> {
        const IS_SEND: bool = true;
    }
    let states = [
        Check::<Stack<'static>>::IS_SEND,
        Check::<State>::IS_SEND,
        Check::<&State>::IS_SEND,
        Check::<mlua::Lua>::IS_SEND,
        Check::<mlua::Table>::IS_SEND,
        Check::<&Owner>::IS_SEND,
    ];
    assert_eq!((Check::<&mut Vec<u8>>::IS_SEND, states), (true, [false; 6]));
}

/// The C library's functions differ in last digits between libraries and processors. That the operator and the library use those of `libm`
/// also shows that the definitions by which Lua was compiled took effect.
#[test]
fn mathematical_functions_are_those_of_libm() {
    with_state(|state| {
        let evaluate = |code: &str, x: f64, y: f64| {
            let chunk = state.lua().load(format!("local x, y = ... return {code}"));
            chunk.call::<f64>((x, y)).expect("it computes")
        };
        let mut random = test_support::random::Random::new(5);
        for _ in 0..300 {
            let (x, y) = (random.unit(), 10.0 * random.signed());
            for (code, expected) in [
                ("math.sin(y)", libm::sin(y)),
                ("math.cos(y)", libm::cos(y)),
                ("math.tan(y)", libm::tan(y)),
                ("math.asin(x)", libm::asin(x)),
                ("math.acos(x)", libm::acos(x)),
                ("math.atan(y, x)", libm::atan2(y, x)),
                ("math.exp(y)", libm::exp(y)),
                ("math.log(x)", libm::log(x)),
                ("math.log(x, 2)", libm::log2(x)),
                ("math.log(x, 10)", libm::log10(x)),
                ("math.pow(x, y)", libm::pow(x, y)),
                ("math.sinh(y)", libm::sinh(y)),
                ("math.cosh(y)", libm::cosh(y)),
                ("math.tanh(y)", libm::tanh(y)),
                ("x ^ y", libm::pow(x, y)),
            ] {
                let computed = evaluate(code, x, y);
                assert_eq!(computed.to_bits(), expected.to_bits(), "{code} {x} {y}");
            }
        }
        assert_eq!(evaluate("0.3 ^ 0.7", 0.0, 0.0), libm::pow(0.3, 0.7));
    });
}

/// With another seed for each state, as Lua has it, the orders would differ.
#[test]
fn names_have_the_same_order_in_each_state() {
    let order = || {
        with_state(|state| {
            let code = "local t, names = {}, {}
                for i = 1, 50 do t['name' .. i] = i end
                for name in pairs(t) do names[#names + 1] = name end
                return table.concat(names, ' ')";
            state.lua().load(code).eval::<String>().expect("it runs")
        })
    };
    assert_eq!(order(), order());
}
