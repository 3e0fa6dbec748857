import { defineConfig } from 'vite';

// The widget of notebooks: one module without imports, for anywidget.
export default defineConfig({
  publicDir: false,
  build: {
    target: 'es2022',
    outDir: '../python/teeter/notebook/static',
    emptyOutDir: true,
    rolldownOptions: { output: { minify: true } },
    lib: { entry: 'src/notebook/widget.ts', formats: ['es'], fileName: () => 'widget.js' },
  },
});
