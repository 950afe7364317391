//! Where a file can be made wrong, and how.
//!
//! Each site is rewritten so that every variant of it stands in the same program, chosen by number when it runs.
//! Operands are evaluated once, before the choice, so that sites nest without growing.

use std::collections::{HashMap, HashSet};

use quote::ToTokens;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{BinOp, Expr, Item, Lit, Member, Stmt, Token, UnOp};

use crate::edit::{Edit, Site};

/// What a visit finds.
pub struct Found {
    /// All sites, also those whose variants are all dropped.
    pub sites: Vec<Site>,
    /// Edits of the sites that are left.
    pub edits: Vec<Edit>,
}

/// Constants of the crate by name, with the path of the function that stands for each; absent where the name is not unique.
pub type Constants = HashMap<String, String>;

/// Visits one file. `first` is the number of its first variant; `dropped` holds numbers of variants that do not compile,
/// `dropped_sites` the indices of sites that do not.
pub fn find(
    text: &str,
    first: u32,
    constants: &Constants,
    dropped: &HashSet<u32>,
    dropped_sites: &HashSet<usize>,
    faults: &[Fault],
) -> Result<Found, String> {
    let file = syn::parse_file(text).map_err(|e| e.to_string())?;
    let mut visitor = Visitor {
        text,
        faults: faults.iter().map(|fault| (fault, false)).collect(),
        constants,
        dropped,
        dropped_sites,
        next: first,
        depth: 0,
        place: false,
        context: Vec::new(),
        found: Found { sites: Vec::new(), edits: Vec::new() },
    };
    visitor.visit_file(&file);
    match visitor.faults.iter().find(|(_, found)| !found) {
        Some((fault, _)) => Err(format!("no place for the fault: {} ({})", fault.what, fault.function)),
        None => Ok(visitor.found),
    }
}

/// A fault that a physicist makes and no tool: part of a function written otherwise.
pub struct Fault {
    /// The function's name.
    pub function: String,
    /// What stands there.
    pub from: String,
    /// What stands there in the variant.
    pub to: String,
    /// In words.
    pub what: String,
}

/// Names of the constants that a file defines outside of traits and functions.
pub fn constants(text: &str) -> Result<Vec<String>, syn::Error> {
    let file = syn::parse_file(text)?;
    Ok(file
        .items
        .iter()
        .filter_map(|item| match item {
            Item::Const(c) if c.generics.params.is_empty() && c.ident != "_" => Some(c.ident.to_string()),
            _ => None,
        })
        .collect())
}

/// The name of the function that gives a constant with its variants.
pub fn function_of(constant: &str) -> String {
    format!("{constant}__mutable")
}

struct Visitor<'a> {
    text: &'a str,
    /// Faults of this file, and whether their place was found.
    faults: Vec<(&'a Fault, bool)>,
    constants: &'a Constants,
    dropped: &'a HashSet<u32>,
    dropped_sites: &'a HashSet<usize>,
    next: u32,
    depth: usize,
    /// Whether the expression visited next names a place rather than a value.
    place: bool,
    context: Vec<String>,
    found: Found,
}

/// A variant: what is said of it, and its code.
type Variant = (String, String);

fn range(node: &impl Spanned) -> (usize, usize) {
    let range = node.span().byte_range();
    (range.start, range.end)
}

impl<'a> Visitor<'a> {
    fn raw(&self, node: &impl Spanned) -> &'a str {
        let (start, end) = range(node);
        &self.text[start..end]
    }

    /// Enters a site: its index, and the variants that are left with their numbers.
    fn enter(&mut self, range: (usize, usize), variants: Vec<Variant>) -> Option<(usize, Vec<(usize, u32, String)>)> {
        if variants.is_empty() {
            return None;
        }
        let index = self.found.sites.len();
        let first = self.next;
        self.next += variants.len() as u32;
        let line = self.text[..range.0].matches('\n').count() + 1;
        self.found.sites.push(Site {
            variants: variants.iter().map(|(label, _)| label.clone()).collect(),
            first,
            line,
            function: self.context.join("::"),
            range,
        });
        if self.dropped_sites.contains(&index) {
            return None;
        }
        let left: Vec<_> = variants
            .into_iter()
            .enumerate()
            .map(|(k, (_, code))| (k, first + k as u32, code))
            .filter(|(_, number, _)| !self.dropped.contains(number))
            .collect();
        (!left.is_empty()).then_some((index, left))
    }

    fn put(&mut self, site: usize, range: (usize, usize), text: String, closes: bool) {
        self.found.edits.push(Edit { range, text, site, depth: self.depth, closes });
    }

    /// A chain of choices that ends with the code as it was.
    fn choice(variants: &[(usize, u32, String)], otherwise: &str) -> String {
        let mut text = String::new();
        for (k, number, code) in variants {
            text += &format!("if crate::mutation::active({number}) {{\u{1}{k};{code}\u{2}}} else ");
        }
        text + &format!("{{ {otherwise} }}")
    }

    /// Operands are bound to `__0`, `__1`... and the code chosen works on them.
    fn bind(
        &mut self,
        whole: (usize, usize),
        operands: &[(usize, usize)],
        variants: Vec<Variant>,
        original: &str,
    ) -> bool {
        let Some((site, left)) = self.enter(whole, variants) else { return false };
        let names: Vec<String> = (0..operands.len()).map(|k| format!("__{k}")).collect();
        self.put(site, (whole.0, operands[0].0), "(match (".into(), false);
        for pair in operands.windows(2) {
            self.put(site, (pair[0].1, pair[1].0), ", ".into(), false);
        }
        let close = format!(",) {{ ({},) => {} }})", names.join(", "), Self::choice(&left, original));
        self.put(site, (operands[operands.len() - 1].1, whole.1), close, true);
        true
    }

    fn inside(&mut self, visit: impl FnOnce(&mut Self)) {
        self.depth += 1;
        visit(self);
        self.depth -= 1;
    }

    fn value(&mut self, expr: &Expr) {
        let before = std::mem::replace(&mut self.place, false);
        self.visit_expr(expr);
        self.place = before;
    }

    fn of_place(&mut self, expr: &Expr) {
        let before = std::mem::replace(&mut self.place, true);
        self.visit_expr(expr);
        self.place = before;
    }

    fn binary(&mut self, binary: &syn::ExprBinary) {
        let whole = range(binary);
        let (left, right) = (range(&binary.left), range(&binary.right));
        let sign = self.raw(&binary.op).to_string();
        let assigned = |op: &str| -> Option<Vec<(&'static str, &'static str)>> {
            Some(match op {
                "+=" => vec![("-=", "-="), ("dropped", "")],
                "-=" => vec![("+=", "+="), ("dropped", "")],
                "*=" => vec![("/=", "/="), ("dropped", "")],
                "/=" => vec![("*=", "*="), ("dropped", "")],
                _ => return None,
            })
        };
        if let Some(others) = assigned(&sign) {
            let place = self.raw(&binary.left).to_string();
            let variants = others
                .iter()
                .map(|(label, op)| {
                    let code = if op.is_empty() { String::new() } else { format!("{place} {op} __0;") };
                    (format!("{sign} -> {label}"), code)
                })
                .collect();
            if let Some((site, left_over)) = self.enter(whole, variants) {
                self.put(site, (whole.0, right.0), "(match (".into(), false);
                let close = format!(") {{ __0 => {} }})", Self::choice(&left_over, &format!("{place} {sign} __0;")));
                self.put(site, (right.1, whole.1), close, true);
            }
            // The left side is written as it was in every variant.
            return self.inside(|v| v.value(&binary.right));
        }
        let bound = match binary.op {
            BinOp::Add(_) => Some("-"),
            BinOp::Sub(_) => Some("+"),
            BinOp::Mul(_) => Some("/"),
            BinOp::Div(_) => Some("*"),
            BinOp::Rem(_) => Some("/"),
            BinOp::Shl(_) => Some(">>"),
            BinOp::Shr(_) => Some("<<"),
            _ => None,
        };
        if let Some(other) = bound {
            let variants = vec![
                (format!("{sign} -> {other}"), format!("__0 {other} __1")),
                (format!("right of {sign} dropped"), "__0".to_string()),
            ];
            self.bind(whole, &[left, right], variants, &format!("__0 {sign} __1"));
        } else if matches!(binary.op, BinOp::And(_) | BinOp::Or(_)) {
            let has_let = |e: &Expr| e.to_token_stream().into_iter().any(|t| t.to_string() == "let");
            if !has_let(&binary.left) && !has_let(&binary.right) {
                let other = if sign == "&&" { "||" } else { "&&" };
                if let Some((site, kept)) = self.enter(whole, vec![(format!("{sign} -> {other}"), String::new())]) {
                    // By De Morgan's laws, so that neither side is written twice.
                    let flag = format!("crate::mutation::active({})", kept[0].1);
                    self.put(site, (whole.0, whole.0), format!("({flag} ^ (({flag} ^ ("), false);
                    self.put(site, (left.1, right.0), format!(")) {sign} ({flag} ^ ("), false);
                    self.put(site, (right.1, right.1), "))))".into(), true);
                }
            }
        } else if matches!(
            binary.op,
            BinOp::Lt(_) | BinOp::Le(_) | BinOp::Gt(_) | BinOp::Ge(_) | BinOp::Eq(_) | BinOp::Ne(_)
        ) {
            if let Some((site, kept)) = self.enter(whole, vec![(format!("{sign} negated"), String::new())]) {
                let flag = format!("crate::mutation::active({})", kept[0].1);
                self.put(site, (whole.0, whole.0), format!("({flag} ^ ("), false);
                self.put(site, (whole.1, whole.1), "))".into(), true);
            }
        }
        self.inside(|v| {
            v.value(&binary.left);
            v.value(&binary.right);
        });
    }

    fn literal(&mut self, literal: &syn::ExprLit) {
        let whole = range(literal);
        let raw = self.raw(literal);
        let other = match &literal.lit {
            Lit::Float(f) => {
                let value: f64 = f.base10_digits().parse().expect("a float");
                let new = if value == 0.0 || (1e-3..=1e3).contains(&value.abs()) { value + 1.0 } else { value * 1e3 };
                format!("{new:?}{}", f.suffix())
            }
            Lit::Int(i) => {
                let Ok(value) = i.base10_parse::<u128>() else { return };
                format!("{}{}", value + 1, i.suffix())
            }
            Lit::Bool(b) => format!("{}", !b.value),
            _ => return,
        };
        if let Some((site, kept)) = self.enter(whole, vec![(format!("{raw} -> {other}"), String::new())]) {
            self.put(site, whole, format!("crate::mutation::pick({}, {raw}, {other})", kept[0].1), false);
        }
    }

    fn call(&mut self, call: &syn::ExprCall) {
        let args: Vec<&Expr> = call.args.iter().collect();
        let name = self.raw(&call.func).to_string();
        let last = name.rsplit("::").next().unwrap_or("").split('<').next().unwrap_or("").trim().to_string();
        let closure = args.iter().any(|a| matches!(a, Expr::Closure(_)));
        let is_path = matches!(*call.func, Expr::Path(_));
        if !args.is_empty() && is_path && !closure && !["Some", "Ok", "Err"].contains(&last.as_str()) {
            let names: Vec<String> = (0..args.len()).map(|k| format!("__{k}")).collect();
            let mut variants = vec![(format!("-{last}(..)"), format!("-{name}({})", names.join(", ")))];
            for k in 1..args.len() {
                let mut swapped = names.clone();
                swapped.swap(k - 1, k);
                variants.push((
                    format!("{last}: arguments {k} and {} swapped", k + 1),
                    format!("{name}({})", swapped.join(", ")),
                ));
            }
            let operands: Vec<_> = args.iter().map(|a| range(*a)).collect();
            self.bind(range(call), &operands, variants, &format!("{name}({})", names.join(", ")));
        }
        self.inside(|v| args.iter().for_each(|a| v.value(a)));
    }

    fn method(&mut self, call: &syn::ExprMethodCall) {
        let name = call.method.to_string();
        let args: Vec<&Expr> = call.args.iter().collect();
        let names: Vec<String> = (1..=args.len()).map(|k| format!("__{k}")).collect();
        let list = names.join(", ");
        let swap = |other: &str| vec![(format!(".{name} -> .{other}"), format!("__0.{other}({list})"))];
        let drop = || vec![(format!(".{name} dropped"), "__0".to_string())];
        let negate = || vec![(format!("-(.{name})"), format!("-__0.{name}({list})"))];
        let variants = match (name.as_str(), args.len()) {
            ("sin", 0) => swap("cos"),
            ("cos", 0) => swap("sin"),
            ("sinh", 0) => swap("cosh"),
            ("cosh", 0) => swap("sinh"),
            ("floor", 0) => swap("ceil"),
            ("ceil", 0) => swap("floor"),
            ("min", 1) => swap("max"),
            ("max", 1) => swap("min"),
            ("any", 1) => swap("all"),
            ("all", 1) => swap("any"),
            ("is_some", 0) => swap("is_none"),
            ("is_none", 0) => swap("is_some"),
            ("is_ok", 0) => swap("is_err"),
            ("is_err", 0) => swap("is_ok"),
            ("exp", 0) => swap("recip"),
            ("sin_cos", 0) => {
                vec![(".sin_cos swapped".to_string(), "{ let (s, c) = __0.sin_cos(); (c, s) }".to_string())]
            }
            ("transpose" | "abs" | "sqrt" | "recip" | "conj" | "round" | "trunc" | "normalize" | "ln" | "rev", 0) => {
                drop()
            }
            ("powi" | "clamp" | "rem_euclid" | "copysign", _) => drop(),
            ("mul_add", 2) => vec![
                (".mul_add: sum dropped".to_string(), "__0 * __1".to_string()),
                (".mul_add: minus".to_string(), "__0.mul_add(__1, -__2)".to_string()),
            ],
            ("cross" | "dot" | "atan2" | "tan" | "atan" | "asin" | "acos" | "tr_mul" | "component_mul", _) => {
                let mut variants = negate();
                if name == "atan2" {
                    variants.push((".atan2 swapped".to_string(), "__1.atan2(__0)".to_string()));
                }
                variants
            }
            _ => Vec::new(),
        };
        if !variants.is_empty() && call.turbofish.is_none() {
            let mut operands = vec![range(&call.receiver)];
            operands.extend(args.iter().map(|a| range(*a)));
            self.bind(range(call), &operands, variants, &format!("__0.{name}({list})"));
        }
        self.inside(|v| {
            v.value(&call.receiver);
            args.iter().for_each(|a| v.value(a));
        });
    }

    fn field(&mut self, field: &syn::ExprField) {
        let simple = {
            let mut base = &*field.base;
            while let Expr::Field(inner) = base {
                base = &inner.base;
            }
            matches!(base, Expr::Path(_))
        };
        if !self.place && simple {
            let other = match &field.member {
                Member::Named(name) => match name.to_string().as_str() {
                    "x" => "y",
                    "y" => "z",
                    "z" => "x",
                    "xx" => "yy",
                    "yy" => "zz",
                    "zz" => "xx",
                    "alpha" => "gamma",
                    "gamma" => "alpha",
                    "sin" => "cos",
                    "cos" => "sin",
                    "re" => "im",
                    "im" => "re",
                    _ => "",
                }
                .to_string(),
                Member::Unnamed(index) if index.index == 0 => "1".to_string(),
                Member::Unnamed(_) => "0".to_string(),
            };
            if !other.is_empty() {
                let (raw, base) = (self.raw(field).to_string(), self.raw(&field.base).to_string());
                let variant = (format!("{raw} -> {base}.{other}"), format!("{base}.{other}"));
                if let Some((site, kept)) = self.enter(range(field), vec![variant]) {
                    let whole = range(field);
                    self.put(site, whole, format!("({})", Self::choice(&kept, &raw)), false);
                }
                return;
            }
        }
        self.inside(|v| v.of_place(&field.base));
    }

    fn structure(&mut self, literal: &syn::ExprStruct) {
        let fields: Vec<_> = literal.fields.iter().collect();
        let closure = fields.iter().any(|f| matches!(f.expr, Expr::Closure(_)));
        if literal.rest.is_none() && fields.len() >= 2 && !closure {
            let path = self.raw(&literal.path).to_string();
            let write = |order: &[usize]| {
                let list: Vec<String> =
                    fields.iter().zip(order).map(|(f, k)| format!("{}: __{k}", f.member.to_token_stream())).collect();
                format!("{path} {{ {} }}", list.join(", "))
            };
            let straight: Vec<usize> = (0..fields.len()).collect();
            let variants = (1..fields.len())
                .map(|k| {
                    let mut order = straight.clone();
                    order.swap(k - 1, k);
                    let name = |j: usize| fields[j].member.to_token_stream().to_string();
                    (format!("{path}: {} and {} swapped", name(k - 1), name(k)), write(&order))
                })
                .collect();
            let operands: Vec<_> = fields.iter().map(|f| range(&f.expr)).collect();
            self.bind(range(literal), &operands, variants, &write(&straight));
        } else if let Some(rest) = &literal.rest {
            self.inside(|v| v.value(rest));
        }
        self.inside(|v| fields.iter().for_each(|f| v.value(&f.expr)));
    }

    fn constant_used(&mut self, path: &syn::ExprPath) {
        let Some(last) = path.path.segments.last() else { return };
        let Some(function) = self.constants.get(&last.ident.to_string()) else { return };
        if path.qself.is_some() || !matches!(last.arguments, syn::PathArguments::None) {
            return;
        }
        // No variant of its own: the variants are in the function.
        let index = self.found.sites.len();
        let whole = range(path);
        let line = self.text[..whole.0].matches('\n').count() + 1;
        self.found.sites.push(Site {
            variants: Vec::new(),
            first: self.next,
            line,
            function: self.context.join("::"),
            range: whole,
        });
        if !self.dropped_sites.contains(&index) {
            self.put(index, whole, format!("{function}()"), false);
        }
    }

    /// A body with a fault in it, in front of the right one.
    fn faulty(&mut self, name: &str, block: &syn::Block) {
        let whole = range(block);
        let raw = self.raw(block).to_string();
        let mut variants = Vec::new();
        for (fault, found) in self.faults.iter_mut().filter(|(fault, _)| fault.function == name) {
            if raw.contains(&fault.from) {
                *found = true;
                let code = format!("return {};", raw.replacen(&fault.from, &fault.to, 1));
                variants.push((format!("{}: {} -> {}", fault.what, fault.from, fault.to), code));
            }
        }
        if let Some((site, left)) = self.enter(whole, variants) {
            let mut text = String::new();
            for (k, number, code) in left {
                text += &format!(" if crate::mutation::active({number}) {{\u{1}{k};{code}\u{2}}}");
            }
            self.put(site, (whole.0 + 1, whole.0 + 1), text, false);
        }
        self.inside(|v| v.visit_block(block));
    }

    fn named(&mut self, name: String, visit: impl FnOnce(&mut Self)) {
        self.context.push(name);
        visit(self);
        self.context.pop();
    }
}

/// Functions that the compiler takes hours over with variants in them, since it searches the types of chained matrix operators.
/// They are left to mutants that are built one by one.
const SKIPPED: [&str; 1] = ["preferred_frame_parameter"];

fn skipped(name: &syn::Ident) -> bool {
    SKIPPED.iter().any(|skipped| name == skipped)
}

fn of_tests(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|a| a.path().is_ident("cfg") && a.meta.to_token_stream().to_string().contains("test"))
}

impl<'ast> Visit<'ast> for Visitor<'_> {
    fn visit_item(&mut self, item: &'ast Item) {
        match item {
            Item::Mod(m) if of_tests(&m.attrs) => {}
            Item::Static(_) | Item::Enum(_) | Item::Struct(_) | Item::Type(_) | Item::Use(_) | Item::Macro(_) => {}
            Item::Const(c) if c.ident != "_" && c.generics.params.is_empty() => {
                if !self.constants.contains_key(&c.ident.to_string()) {
                    return;
                }
                // A function with the same value, to be called where the constant is used; the constant itself stays.
                let name = c.ident.to_string();
                let index = self.found.sites.len();
                let (whole, value) = (range(c), range(&*c.expr));
                self.found.sites.push(Site {
                    variants: Vec::new(),
                    first: self.next,
                    line: self.text[..whole.0].matches('\n').count() + 1,
                    function: name.clone(),
                    range: whole,
                });
                if self.dropped_sites.contains(&index) {
                    return;
                }
                let raw = self.raw(c).to_string();
                let head = format!(
                    "{raw}\n#[allow(non_snake_case)] #[inline] pub(crate) fn {}() -> {} {{ ",
                    function_of(&name),
                    self.raw(&*c.ty)
                );
                self.put(index, (whole.0, value.0), head, false);
                self.put(index, (value.1, whole.1), " }".into(), true);
                self.named(name, |v| v.inside(|v| v.value(&c.expr)));
            }
            Item::Fn(f) if f.sig.constness.is_some() || of_tests(&f.attrs) || skipped(&f.sig.ident) => {}
            Item::Impl(i) => {
                let name = i.self_ty.to_token_stream().to_string().replace(' ', "");
                self.named(name, |v| visit::visit_item_impl(v, i));
            }
            _ => visit::visit_item(self, item),
        }
    }

    fn visit_item_fn(&mut self, f: &'ast syn::ItemFn) {
        let name = f.sig.ident.to_string();
        self.named(name.clone(), |v| v.faulty(&name, &f.block));
    }

    fn visit_impl_item_fn(&mut self, f: &'ast syn::ImplItemFn) {
        if f.sig.constness.is_none() && f.sig.ident != "fmt" {
            let name = f.sig.ident.to_string();
            self.named(name.clone(), |v| v.faulty(&name, &f.block));
        }
    }

    fn visit_trait_item_fn(&mut self, f: &'ast syn::TraitItemFn) {
        if let Some(block) = &f.default {
            self.named(f.sig.ident.to_string(), |v| v.visit_block(block));
        }
    }

    fn visit_impl_item_const(&mut self, _: &'ast syn::ImplItemConst) {}
    fn visit_trait_item_const(&mut self, _: &'ast syn::TraitItemConst) {}
    fn visit_pat(&mut self, _: &'ast syn::Pat) {}
    fn visit_type(&mut self, _: &'ast syn::Type) {}
    fn visit_attribute(&mut self, _: &'ast syn::Attribute) {}
    fn visit_generic_argument(&mut self, _: &'ast syn::GenericArgument) {}
    fn visit_expr_const(&mut self, _: &'ast syn::ExprConst) {}

    fn visit_expr_repeat(&mut self, repeat: &'ast syn::ExprRepeat) {
        self.inside(|v| v.value(&repeat.expr));
    }

    fn visit_stmt(&mut self, stmt: &'ast Stmt) {
        if let Stmt::Expr(expr, Some(_)) = stmt {
            let what = match expr {
                Expr::MethodCall(_) | Expr::Call(_) => "call dropped",
                Expr::Assign(_) => "assignment dropped",
                _ => "",
            };
            if !what.is_empty() {
                let whole = range(stmt);
                let shown: String = self.raw(stmt).chars().take(60).collect();
                if let Some((site, kept)) = self.enter(whole, vec![(format!("{what}: {shown}"), String::new())]) {
                    self.put(
                        site,
                        (whole.0, whole.0),
                        format!("if !crate::mutation::active({}) {{ ", kept[0].1),
                        false,
                    );
                    self.put(site, (whole.1, whole.1), " }".into(), true);
                }
                return self.inside(|v| visit::visit_stmt(v, stmt));
            }
        }
        visit::visit_stmt(self, stmt);
    }

    fn visit_macro(&mut self, mac: &'ast syn::Macro) {
        if mac.path.is_ident("vec") {
            if let Ok(list) = mac.parse_body_with(Punctuated::<Expr, Token![,]>::parse_terminated) {
                self.inside(|v| list.iter().for_each(|e| v.value(e)));
            }
        }
    }

    fn visit_expr(&mut self, expr: &'ast Expr) {
        match expr {
            Expr::Binary(binary) => self.binary(binary),
            Expr::Lit(literal) => self.literal(literal),
            Expr::Call(call) => self.call(call),
            Expr::MethodCall(call) => self.method(call),
            Expr::Field(field) => self.field(field),
            Expr::Struct(literal) => self.structure(literal),
            Expr::Path(path) => self.constant_used(path),
            Expr::Unary(unary) => {
                let (whole, operand) = (range(unary), range(&*unary.expr));
                match unary.op {
                    UnOp::Neg(_) => {
                        self.bind(whole, &[operand], vec![("- dropped".to_string(), "__0".to_string())], "-__0");
                    }
                    UnOp::Not(_) => {
                        self.bind(whole, &[operand], vec![("! dropped".to_string(), "__0".to_string())], "!__0");
                    }
                    _ => return self.inside(|v| v.of_place(&unary.expr)),
                }
                self.inside(|v| v.value(&unary.expr));
            }
            Expr::Reference(reference) => self.inside(|v| v.of_place(&reference.expr)),
            Expr::Assign(assign) => self.inside(|v| {
                v.of_place(&assign.left);
                v.value(&assign.right);
            }),
            Expr::Index(index) => self.inside(|v| {
                v.of_place(&index.expr);
                v.value(&index.index);
            }),
            _ => self.inside(|v| {
                let before = std::mem::replace(&mut v.place, false);
                visit::visit_expr(v, expr);
                v.place = before;
            }),
        }
    }
}
