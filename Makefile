# `make play` and `make test` set up what is missing. Anything longer than a line is in tools/.
.PHONY: help play page test golden fuzz check format bench counts figures peers pictures site wheel clean setup

help: ## List the targets
	@sed -n 's/^\([a-z]*\):.*## /\1\t/p' $(MAKEFILE_LIST) | column -t -s '	'

play: page ## Build what is missing, serve the page and open it
	cargo run --release --locked -p teeter-cli --features page -- play $(ARGS)

page: ## Build the page into web/dist
	tools/setup rust node wasm packages
	tools/build-wasm
	tools/build-page

test: page ## Run every test: Rust, examples, Python, WebAssembly under node, the page in headless Chromium
	tools/setup browser python
	tools/test

golden: ## Run the golden runs in every build and mode, and print the matrix
	tools/setup rust node wasm
	tools/golden check

fuzz: ## Fuzz every target for an hour; SECONDS=60 for a minute
	tools/fuzz $(or $(SECONDS),3600)

check: page ## Formatting, lints, words, documents and packages
	tools/words
	tools/circles
	tools/docs
	cargo fmt --all --check
	cargo clippy --workspace --all-targets --locked --features teeter-cli/page -- -D warnings
	RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps --locked --features teeter-cli/page
	tools/package
	tools/dependencies check
	tools/setup python
	tools/python check
	cd web && npm run check && npx prettier --config .prettierrc.json --check ../tools/checks

format: ## Format everything
	cargo fmt --all
	cd web && npm run format && npx prettier --config .prettierrc.json --write ../tools/checks

bench: page ## Measure everything: frames, figures, the page in headless Chromium, and instructions
	tools/setup browser
	cargo bench --locked -p teeter-cost --bench frame
	tools/figures --rounds 15
	cd web && npm run speed
	tools/counts check

counts: ## Count the instructions of the engine; fails where one costs more than was accepted
	tools/counts check

figures: ## Measure the cost of a tower natively and in WebAssembly, and write docs/performance.md
	tools/figures

peers: ## Measure the engine beside Rapier and Box3D, and write docs/performance.md
	tools/peers

pictures: ## Draw the pictures of the documents into docs/pictures
	tools/pictures

site: page ## Build the manual: guides, reference, method and results, in target/site/html
	tools/setup python
	tools/python build
	tools/site

wheel: site ## Build the Python package, install it in a fresh environment, and test it there
	tools/setup python
	tools/python wheel

setup: ## Install everything that is missing, the browser included
	tools/setup

clean: ## Remove what was built
	rm -rf target web/dist web/src/wasm web/wasm-scalar web/node_modules
