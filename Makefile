# `make play` and `make test` set up what is missing. What is longer than a line or two is in tools/.
.PHONY: help play page test golden check format bench counts figures peers clean setup

help: ## Say what there is
	@sed -n 's/^\([a-z]*\):.*## /\1\t/p' $(MAKEFILE_LIST) | column -t -s '	'

play: page ## Build what is missing, serve the page and open it
	cargo run --release --locked -p teeter-cli --features page -- play $(ARGS)

page: ## Build the page into web/dist
	tools/setup rust node wasm packages
	tools/build-wasm
	cd web && npm run build

test: page ## Run every test: Rust, WebAssembly under node, the page in headless Chromium
	tools/setup browser
	cargo test --workspace --locked --features teeter-cli/page
	cargo test --locked -p teeter-cli --test play
	tools/build-wasm scalar
	cd web && npm test

golden: ## Play the golden runs in every build and way to run, and print the matrix
	tools/setup rust node wasm
	tools/golden check

check: ## Formatting and lints
	tools/setup rust
	cargo fmt --all --check
	$(MAKE) page
	cargo clippy --workspace --all-targets --locked --features teeter-cli/page -- -D warnings
	cd web && npm run check

format: ## Format everything
	cargo fmt --all
	cd web && npm run format

bench: page ## Measure everything: frames, figures, the page in headless Chromium, and instructions
	tools/setup browser
	cargo bench --locked -p teeter-cost --bench frame
	tools/figures --rounds 15
	cd web && npm run speed
	tools/counts check

counts: ## Count the instructions of the engine; fails where one costs more than was accepted
	tools/counts check

figures: ## Measure what a tower costs natively and in WebAssembly, and write docs/performance.md
	tools/figures

peers: ## Measure the engine beside Rapier and Box3D, and write docs/performance.md
	tools/peers

setup: ## Install everything that is missing, the browser included
	tools/setup

clean: ## Remove what was built
	rm -rf target web/dist web/src/wasm web/wasm-scalar web/node_modules
